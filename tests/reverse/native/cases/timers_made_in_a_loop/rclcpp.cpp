#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    for (int k = 0; k < 3; ++k) {
      timers_.push_back(create_wall_timer(std::chrono::seconds(1 + k), [this, k] { tick(k); }));
    }
  }

 private:
  void tick(int k) { put(20 + k); }

  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  std::vector<rclcpp::TimerBase::SharedPtr> timers_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
