#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    for (int i = 0; i < 3; ++i) {
      subs_.push_back(create_subscription<Int32>(
          "in" + std::to_string(i), 9, [this, i](const Int32&) { cb(i + 2); }));
    }
  }

 private:
  void cb(int i) { put(i); }

  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  std::vector<rclcpp::Subscription<Int32>::SharedPtr> subs_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
