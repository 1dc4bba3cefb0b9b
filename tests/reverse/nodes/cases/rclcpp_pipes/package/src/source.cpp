#include "pipes/source.hpp"

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Source>());
  rclcpp::shutdown();
}
