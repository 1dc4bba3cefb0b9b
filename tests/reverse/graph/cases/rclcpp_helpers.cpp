// Helpers of packages that are not read declare parameters; one that is there is read itself.
#include "nav2_util/node_utils.hpp"
#include "rclcpp/rclcpp.hpp"
using nav2_util::declare_parameter_if_not_declared;

class Helped : public rclcpp::Node {
 public:
  Helped() : Node("helped") {  //= node "helped"
    nav2_util::declare_parameter_if_not_declared(this, "rate", rclcpp::ParameterValue(5.0));  //= parameter declare "rate" = 5.0
    declare_parameter_if_not_declared(this, name_ + ".speed", rclcpp::ParameterValue(2));  //= parameter declare "base.speed" = 2
  }

 private:
  std::string name_ = "base";
};
