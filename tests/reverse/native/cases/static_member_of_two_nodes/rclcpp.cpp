#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class N : public rclcpp::Node {
 public:
  explicit N(const std::string& name) : Node(name) {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
  }

 private:
  void cb(const Int32& m) {
    count_ += m.data;
    Int32 msg;
    msg.data = count_;
    pub_->publish(msg);
  }

  static int count_;
  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
};

int N::count_ = 0;

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::executors::SingleThreadedExecutor executor;
  auto first = std::make_shared<N>("n");
  auto second = std::make_shared<N>("m");
  executor.add_node(first);
  executor.add_node(second);
  executor.spin();
}
