#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

struct Add {
  explicit Add(rclcpp::Publisher<Int32>::SharedPtr pub) : pub_(pub) {}
  void operator()(const Int32& m) const {
    Int32 out;
    out.data = m.data + 3;
    pub_->publish(out);
  }
  rclcpp::Publisher<Int32>::SharedPtr pub_;
};

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, Add(pub_));
  }

 private:
  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  int x_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
