// Parameters on objects of which no file tells the class, and on the part of a node that has them.
#include <rclcpp/rclcpp.hpp>
template <typename NodeT>
void declare_once(NodeT node, const std::string & name, const rclcpp::ParameterValue & value) {
  if (!node->has_parameter(name)) {  //= parameter has "a" | "b"
    node->declare_parameter(name, value);  //= parameter declare "a" | "b" = 1 | 2
  }
}
class Reflex {
 public:
  Reflex(rclcpp::node_interfaces::NodeParametersInterface::SharedPtr parameters) : parameters_(parameters) {
    parameters_->declare_parameter("reflex", rclcpp::ParameterValue(true));  //= parameter declare "reflex" = true
    parameters->get_parameter("reflex");  //= parameter get "reflex"
  }
  rclcpp::node_interfaces::NodeParametersInterface::SharedPtr parameters_;
};
class Plug {
  void configure(const outer::Owner::WeakPtr & parent) {
    auto node = parent.lock();
    declare_once(node, "a", rclcpp::ParameterValue(1));
    declare_once(node, "b", rclcpp::ParameterValue(2));
    node->get_parameter("speed", speed_);  //= parameter get "speed"
    node->get_parameter(prefix_ + ".gain", speed_);  //= parameter get ?
    node->get_parameters({"u", "v"});  //= parameter get "u" //= parameter get "v"
    node->set_parameter(rclcpp::Parameter("w", 1));  //= parameter set "w" := 1
    client_->get_parameter("other");
    sync_->get_parameter("other");
    map_.get_parameter(3);
  }
  std::string prefix_;
  std::shared_ptr<rclcpp::SyncParametersClient> sync_;
  rclcpp::AsyncParametersClient::SharedPtr client_;
  lib::Map map_;
};
