#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
using std_msgs::msg::Int32;
class N : public rclcpp::Node {
 public:
  N() : Node("node") {
    pub_ = create_publisher<Int32>("out", 10);
    declare_parameter("speed", 2);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this] { Int32 o; o.data = get_parameter("speed").as_int(); pub_->publish(o); });
  }
 private:
  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::TimerBase::SharedPtr timer_;
};
int main(int c, char** v) { rclcpp::init(c, v); rclcpp::spin(std::make_shared<N>()); }
