#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class Helper {
 public:
  explicit Helper(rclcpp::Publisher<Int32>::SharedPtr pub) : pub_(pub) {}
  void on_message(const Int32& m) {
    count_ += m.data;
    Int32 out;
    out.data = count_;
    pub_->publish(out);
  }

 private:
  rclcpp::Publisher<Int32>::SharedPtr pub_;
  int count_ = 7;
};

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    helper_ = std::make_shared<Helper>(pub_);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { helper_->on_message(m); });
  }

 private:
  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  std::shared_ptr<Helper> helper_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
