#include <rclcpp/rclcpp.hpp>
#include <rclcpp_action/rclcpp_action.hpp>

class Planner : public rclcpp::Node
{
public:
  Planner() : Node("planner")
  {
    scan_ = create_subscription<sensor_msgs::msg::LaserScan>("scan", 5, on_scan);
    speed_ = create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 1);
    server_ = rclcpp_action::create_server<robot_msgs::action::Go>(this, "go", goal, cancel, on);
  }
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Planner>());
}
