// Publishes the last message again, which is changed after it was kept.
#include <chrono>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/float64.hpp>

using std_msgs::msg::Float64;

class Again : public rclcpp::Node {
 public:
  Again() : Node("again") {
    pub_ = create_publisher<Float64>("out", 1);
    sub_ = create_subscription<Float64>("in", 1, [this](Float64::SharedPtr msg) { keep(msg); });
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() { tick(); });
  }

 private:
  void keep(const Float64::SharedPtr msg) {
    last_ = msg;
    msg->data = 5.0;
  }

  void tick() {
    if (!last_) {
      return;
    }
    pub_->publish(*last_);
  }

  rclcpp::Publisher<Float64>::SharedPtr pub_;
  rclcpp::Subscription<Float64>::SharedPtr sub_;
  rclcpp::TimerBase::SharedPtr timer_;
  Float64::SharedPtr last_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Again>());
  rclcpp::shutdown();
}
