#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
  }

 private:
  void cb(const Int32&) {
    auto loaned = pub_->borrow_loaned_message();
    loaned.get().data = 7;
    pub_->publish(std::move(loaned));
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
