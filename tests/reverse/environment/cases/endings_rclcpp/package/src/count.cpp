#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Count : public rclcpp::Node {
 public:
  Count() : Node("count_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("count", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "count_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    for (int i = 0; i < 3; i++) {
      switch (message->data) {
        case 1:
          continue;
      }
      count_++;
    }
    send(count_);
    count_ = 0;
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  int count_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Count>());
  rclcpp::shutdown();
}
