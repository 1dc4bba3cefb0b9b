// Functions that fill what pointers lead to, if they lead anywhere.
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Outputs : public rclcpp::Node {
 public:
  Outputs() : Node("outputs") {
    level_ = create_publisher<std_msgs::msg::Int32>("level", 1);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "in", 1, std::bind(&Outputs::onIn, this, std::placeholders::_1));
  }

 private:
  void clear(int* level) {
    if (level) {
      *level = 0;
    }
  }

  bool read(int from, int* level) {
    if (level == nullptr || from < 3) {
      return false;
    }
    *level = from;
    return true;
  }

  void fill(int level, std_msgs::msg::Int32* message) {
    if (!message) {
      return;
    }
    message->data = level;
  }

  void onIn(std_msgs::msg::Int32::ConstSharedPtr in) {
    int level = 7;
    clear(&level);
    if (!read(in->data, &level)) {
      level = level == 0 ? 1 : -1;
    }
    std_msgs::msg::Int32 message;
    fill(level, &message);
    level_->publish(message);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr level_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Outputs>());
  rclcpp::shutdown();
}
