// Goes by words.
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
#include <std_msgs/msg/string.hpp>
#include <string>

#define RESET "reset"
static const std::string START = "start";
constexpr const char* FINISH = "finish";

class Words : public rclcpp::Node {
 public:
  Words() : Node("words") {
    level_ = create_publisher<std_msgs::msg::Int32>("level", 1);
    status_ = create_publisher<std_msgs::msg::String>("status", 1);
    sub_ = create_subscription<std_msgs::msg::String>(
        "command", 1, [this](const std_msgs::msg::String& msg) { onCommand(msg.data); });
  }

 private:
  void onCommand(const std::string& word) {
    if (word.empty()) {
      enter("idle", 3);
    } else if (state_ == "idle" && word == START) {
      enter("running", 1);
    } else if (state_ == "running" && word.compare(FINISH) == 0) {
      enter("done", 2);
    } else if (word == RESET) {
      state_.clear();
      enter("idle", 0);
    }
  }

  void enter(const std::string& state, int level) {
    state_ = state;
    std_msgs::msg::Int32 out;
    out.data = level;
    level_->publish(out);
    std_msgs::msg::String status;
    status.data = state_;
    status_->publish(status);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr level_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr status_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr sub_;
  std::string state_ = "idle";
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Words>());
  rclcpp::shutdown();
}
