#include <future>

#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { first_.set_value(m.data); });
  }
  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }
  std::promise<int> first_;

 private:
  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<N>();
  std::shared_future<int> first = node->first_.get_future().share();
  rclcpp::spin_until_future_complete(node, first);
  node->put(first.get() + 10);
}
