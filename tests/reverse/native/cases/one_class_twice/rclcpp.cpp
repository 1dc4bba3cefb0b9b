#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class N : public rclcpp::Node {
 public:
  N(const std::string& name, int k) : Node(name), k_(k) {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
  }

 private:
  void cb(const Int32& m) {
    k_ += m.data;
    Int32 msg;
    msg.data = k_;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  int k_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::executors::SingleThreadedExecutor executor;
  auto first = std::make_shared<N>("n", 1);
  auto second = std::make_shared<N>("m", 11);
  executor.add_node(first);
  executor.add_node(second);
  executor.spin();
}
