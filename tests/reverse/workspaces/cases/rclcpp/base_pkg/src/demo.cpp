#include "base_pkg/base.hpp"

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<base_pkg::Other>());
  rclcpp::shutdown();
}
