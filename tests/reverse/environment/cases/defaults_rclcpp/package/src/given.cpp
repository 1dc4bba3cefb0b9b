// A default value that reads a member which the constructor gives another value.
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
using Int32 = std_msgs::msg::Int32;

class Given : public rclcpp::Node {
 public:
  Given() : Node("given"), low_(5), high_(20) {
    out_ = create_publisher<Int32>("given", 10);
    sub_ = create_subscription<Int32>("ask", 10, [this](Int32::ConstSharedPtr) {
      Int32 message;
      message.data = middle_ + last_;
      out_->publish(message);
    });
  }

 private:
  int twice() const { return high_ * 2; }

  int low_ = 1;
  int middle_ = low_ + 1;
  int high_ = middle_ + 1;
  int last_ = twice();
  rclcpp::Publisher<Int32>::SharedPtr out_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Given>());
  rclcpp::shutdown();
}
