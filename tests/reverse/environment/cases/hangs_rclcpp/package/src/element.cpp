#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Element : public rclcpp::Node {
 public:
  Element() : Node("element_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("element", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "element_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void change(const int& value) {
    values_[index_] = 5;
    send(value);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    values_[index_] = 1;
    change(values_[index_]);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  int values_[2] = {0, 0};
  int index_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Element>());
  rclcpp::shutdown();
}
