#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;
using namespace std::chrono_literals;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
    send_ = [pub = pub_](int v) {
      Int32 msg;
      msg.data = v;
      pub->publish(msg);
    };
  }

 private:
  void cb(const Int32&) { send_(2); }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  std::function<void(int)> send_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
