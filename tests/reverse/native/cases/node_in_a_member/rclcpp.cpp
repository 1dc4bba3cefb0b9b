#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class N {
 public:
  explicit N(rclcpp::Node::SharedPtr node) : node_(node) {
    pub_ = node_->create_publisher<Int32>("out", 9);
    sub_ = node_->create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
  }

 private:
  void cb(const Int32& m) {
    x_ += m.data;
    Int32 msg;
    msg.data = x_;
    pub_->publish(msg);
  }

  rclcpp::Node::SharedPtr node_;
  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  int x_ = 2;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("n");
  N n(node);
  rclcpp::spin(node);
}
