#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Field : public rclcpp::Node {
 public:
  Field() : Node("field_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("field", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "field_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void change(const int& value) {
    kept_.data = 5;
    send(value);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    kept_.data = 1;
    change(kept_.data);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  std_msgs::msg::Int32 kept_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Field>());
  rclcpp::shutdown();
}
