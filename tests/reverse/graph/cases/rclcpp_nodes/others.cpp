#include <map>
#include "example_interfaces/srv/add_two_ints.hpp"
#include "nav_msgs/msg/occupancy_grid.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "std_msgs/msg/int32.hpp"

using Add = example_interfaces::srv::AddTwoInts;

static void add(const std::shared_ptr<Add::Request> in, std::shared_ptr<Add::Response> out) {}
static void count(const std_msgs::msg::Int32 & msg) {}

// Names and topics that those who make it choose.
struct Pipe : public rclcpp::Node {
  Pipe(const std::string & name, const std::string & to) : Node(name) {  //= node "first" | "second"
    using std_msgs::msg::Int32;
    pub_ = this->create_publisher<Int32>(to, rclcpp::QoS(rclcpp::KeepAll()).reliable());  //= publisher "a" | "b" "std_msgs/Int32" 0
  }
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr pub_;
};

// A node of its own library, with a method of that name that is its own.
class Store {
 public:
  void declare_parameter(const std::string & name, int value) {}
};

class Managed : public rclcpp_lifecycle::LifecycleNode {
 public:
  Managed() : rclcpp_lifecycle::LifecycleNode("managed") {  //= node "managed"
    std::map<std::string, int64_t> axes{{"x", 5L}, {"y", -1L}};
    declare_parameters("axis", axes);  //= parameter declare "axis.x" = 5 //= parameter declare "axis.y" = -1
    if (has_parameter("old")) {  //= parameter has "old"
      undeclare_parameter("old");  //= parameter delete "old"
    }
    bool on;
    get_parameter_or("on", on, true);  //= parameter get "on" = true
    set_parameter(rclcpp::Parameter("axis.x", 4));  //= parameter set "axis.x" := 4
    store_.declare_parameter("mine", 1);
    pub_ = create_generic_publisher("any", "std_msgs/msg/Int32", rclcpp::SystemDefaultsQoS());  //= publisher "any" "std_msgs/Int32" 0
  }

 private:
  Store store_;
  rclcpp::GenericPublisher::SharedPtr pub_;
};

int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto first = std::make_shared<Pipe>("first", "a");
  auto second = std::make_shared<Pipe>("second", "b");
  auto node = rclcpp::Node::make_shared("main");  //= node "main"
  auto plain = std::make_shared<rclcpp::Node>("plain");  //= node "plain"
  auto server = node->create_service<Add>("add", add);  //= service "add" "example_interfaces/AddTwoInts" -> add
  auto client = plain->create_client<Add>("/add");  //= client "/add" "example_interfaces/AddTwoInts"
  auto sub = node->create_subscription<std_msgs::msg::Int32>("a", 10, count);  //= subscription "a" "std_msgs/Int32" 10 -> count
  auto map = node->create_publisher<nav_msgs::msg::OccupancyGrid>("map", rclcpp::QoS{1}.transient_local());  //= publisher "map" "nav_msgs/OccupancyGrid" 1 latched=true
  rclcpp::Rate rate(10);  //= rate 10
  rclcpp::WallRate slow(2s);  //= rate 0.5 wall
  while (rclcpp::ok()) {
    rclcpp::spin_some(node);
    rate.sleep();
  }
}
