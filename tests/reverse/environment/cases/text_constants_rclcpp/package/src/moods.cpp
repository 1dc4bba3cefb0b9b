#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include <std_msgs/msg/int32.hpp>
#include "moods/msg/mood.hpp"

class Moods : public rclcpp::Node {
 public:
  Moods() : Node("moods") {
    out_ = create_publisher<std_msgs::msg::Int32>("out", 10);
    in_ = create_subscription<moods::msg::Mood>(
        "mood", 10, [this](const moods::msg::Mood& mood) { on(mood); });
  }

 private:
  void on(const moods::msg::Mood& mood) {
    std_msgs::msg::Int32 message;
    if (mood.mood == moods::msg::Mood::HAPPY) {
      message.data = 1;
    } else if (mood.mood == moods::msg::Mood::SAD) {
      message.data = 2;
    } else if (mood.mood == "happy") {
      message.data = 3;
    } else {
      message.data = mood.mood == moods::msg::Mood::CALM ? 5 : 4;
    }
    out_->publish(message);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<moods::msg::Mood>::SharedPtr in_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Moods>());
  rclcpp::shutdown();
}
