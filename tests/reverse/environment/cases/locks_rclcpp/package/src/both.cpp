#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Both : public rclcpp::Node {
 public:
  Both() : Node("both_node") {
    out_ = create_publisher<std_msgs::msg::Int32>("both", 10);
    in_ = create_subscription<std_msgs::msg::Int32>(
        "both_in", 10, [this](std_msgs::msg::Int32::ConstSharedPtr message) { on(message); });
  }

 private:
  void send(int value) {
    std_msgs::msg::Int32 out;
    out.data = value;
    out_->publish(out);
  }

  void on(std_msgs::msg::Int32::ConstSharedPtr message) {
    mutex_.lock();
    mutex_.unlock();
    mutex_.lock();
    int value = message->data > 3 ? 1 : 2;
    mutex_.unlock();
    {
      std::lock_guard<std::mutex> lock(mutex_);
      value += 1;
    }
    send(value);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr in_;
  std::mutex mutex_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Both>());
  rclcpp::shutdown();
}
