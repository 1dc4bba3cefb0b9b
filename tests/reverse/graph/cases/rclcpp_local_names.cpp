// A local by the name of a method of the node: no call of it.
#include <string>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/int32.hpp"

class Named : public rclcpp::Node {
 public:
  Named() : Node("named") {  //= node "named"
    auto declare_parameter = [](const std::string & name) { return name.size(); };
    use(declare_parameter);
    const auto topic = get_parameter("topic").as_string();  //= parameter get "topic"
    out_ = create_publisher<std_msgs::msg::Int32>(topic, 1);  //= publisher {"topic"} "std_msgs/Int32" 1
  }

 private:
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
};
