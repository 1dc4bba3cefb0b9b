#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;
using namespace std::chrono_literals;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
    timer_ = create_wall_timer(250ms, std::bind(&N::tick, this));
  }

 private:
  void tick() {
    ++x_;
    timer_->cancel();
    if (x_ > 1) put(9);
  }

  void cb(const Int32&) { timer_->reset(); }

  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  rclcpp::TimerBase::SharedPtr timer_;
  int x_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
