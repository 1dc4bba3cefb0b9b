#include <rclcpp/rclcpp.hpp>

class Driver : public rclcpp::Node
{
public:
  Driver() : Node("driver")
  {
    const auto topic = declare_parameter("topic", std::string("scan"));
    scan_ = create_publisher<sensor_msgs::msg::LaserScan>(topic, rclcpp::SensorDataQoS());
    speed_ = create_subscription<geometry_msgs::msg::Twist>("cmd_vel", 1, on_speed);
    stop_ = create_service<std_srvs::srv::Empty>("~/stop", on_stop);
    debug_ = create_publisher<std_msgs::msg::String>(name_of(this), 1);
  }
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Driver>());
}
