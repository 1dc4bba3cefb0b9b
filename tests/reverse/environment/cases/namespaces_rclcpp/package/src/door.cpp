// A door that says itself in which namespace its topics are.
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/bool.hpp>

class Door : public rclcpp::Node {
 public:
  explicit Door(const std::string& side) : Node("door", side) {
    open_ = create_publisher<std_msgs::msg::Bool>("open", 1);
    close_ = create_subscription<std_msgs::msg::Bool>(
        "close", 1, [this](const std_msgs::msg::Bool& message) { open_->publish(message); });
  }

 private:
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr open_;
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr close_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Door>("left"));
  rclcpp::shutdown();
}
