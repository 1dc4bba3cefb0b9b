// Keeps another name for a message that it hands over to callbacks of the process.
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
using Int32 = std_msgs::msg::Int32;

class Handed : public rclcpp::Node {
 public:
  Handed() : Node("handed", rclcpp::NodeOptions().use_intra_process_comms(true)) {
    mid_ = create_publisher<Int32>("mid", 10);
    out_ = create_publisher<Int32>("out", 10);
    cmd_ = create_subscription<Int32>("cmd", 10, [this](Int32::ConstSharedPtr) {
      auto message = std::make_unique<Int32>();
      Int32& same = *message;
      same.data = 1;
      mid_->publish(std::move(message));
      same.data = 2;
    });
    back_ = create_subscription<Int32>(
        "mid", 10, [this](Int32::ConstSharedPtr message) { out_->publish(*message); });
  }

 private:
  rclcpp::Publisher<Int32>::SharedPtr mid_, out_;
  rclcpp::Subscription<Int32>::SharedPtr cmd_, back_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Handed>());
  rclcpp::shutdown();
}
