#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Apart : public rclcpp::Node {
 public:
  Apart() : Node("apart_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("apart", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "apart_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
    group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) { send(1); }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  rclcpp::CallbackGroup::SharedPtr group_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Apart>());
  rclcpp::shutdown();
}
