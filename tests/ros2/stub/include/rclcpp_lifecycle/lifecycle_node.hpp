// rclcpp_lifecycle in one process: others' transitions come at times that the driver is told.
// Written by hand for tests; what it has is less than what rclcpp_lifecycle of Humble has.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <utility>
#include <vector>

namespace rclcpp {

template <class M, class NodeT>
typename Publisher<M>::SharedPtr create_publisher(
    NodeT& node, const std::string& topic, const QoS& qos, const PublisherOptions& options) {
  return node.template fake_publisher<M>(topic, qos, options);
}

inline void spin(const Node* node) {
  node->fake_executor()->run([] { return ok(); });
}

}  // namespace rclcpp

namespace rclcpp_lifecycle {

class State {
 public:
  explicit State(std::string label) : label_(std::move(label)) {}
  const std::string& label() const { return label_; }

 private:
  std::string label_;
};

namespace node_interfaces {

class LifecycleNodeInterface {
 public:
  enum class CallbackReturn { SUCCESS, FAILURE, ERROR };
  virtual ~LifecycleNodeInterface() = default;
  virtual CallbackReturn on_configure(const State&) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_activate(const State&) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_deactivate(const State&) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_cleanup(const State&) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_shutdown(const State&) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_error(const State&) { return CallbackReturn::SUCCESS; }
};

}  // namespace node_interfaces

/// No rclcpp::Node, though it has most of what that has.
class LifecycleNode : public node_interfaces::LifecycleNodeInterface, private rclcpp::Node {
 public:
  explicit LifecycleNode(const std::string& name, const rclcpp::NodeOptions& options)
      : rclcpp::Node(name, options) {
    for (const auto& change : rclcpp::fake::arguments().changes) {
      const auto due = rclcpp::Duration::from_seconds(change.first);
      timers_.push_back(rclcpp::create_timer(static_cast<rclcpp::Node*>(this), get_clock(), due,
          [this, name = change.second](rclcpp::TimerBase& timer) {
            timer.cancel();
            trigger(name);
          }));
    }
  }

  using rclcpp::Node::create_service;
  using rclcpp::Node::create_subscription;
  using rclcpp::Node::create_wall_timer;
  using rclcpp::Node::declare_parameter;
  using rclcpp::Node::get_clock;
  using rclcpp::Node::get_logger;
  using rclcpp::Node::get_name;
  using rclcpp::Node::get_node_topics_interface;
  using rclcpp::Node::get_parameter;
  using rclcpp::Node::get_subscriptions_info_by_topic;
  using rclcpp::Node::has_parameter;
  using rclcpp::Node::now;
  const rclcpp::Node* get_node_base_interface() { return this; }

  template <class M>
  typename rclcpp::Publisher<M>::SharedPtr fake_publisher(
      const std::string& topic, const rclcpp::QoS& qos, const rclcpp::PublisherOptions& options) {
    return create_publisher<M>(topic, qos, options);
  }

  const State& configure() { return trigger("configure"); }
  const State& activate() { return trigger("activate"); }
  const State& get_current_state() const { return state_; }

 private:
  using Callback = CallbackReturn (LifecycleNodeInterface::*)(const State&);

  struct Transition {
    std::string name;
    std::string from;  // empty: whatever it is
    std::string to;
    Callback callback;
  };

  static const std::vector<Transition>& transitions() {
    using Interface = LifecycleNodeInterface;
    static const std::vector<Transition> all{
        {"configure", "unconfigured", "inactive", &Interface::on_configure},
        {"activate", "inactive", "active", &Interface::on_activate},
        {"deactivate", "active", "inactive", &Interface::on_deactivate},
        {"cleanup", "inactive", "unconfigured", &Interface::on_cleanup},
        {"shutdown", "", "finalized", &Interface::on_shutdown},
    };
    return all;
  }

  const State& trigger(const std::string& name) {
    for (const Transition& transition : transitions()) {
      if (transition.name != name) continue;
      if (!transition.from.empty() && transition.from != state_.label()) break;
      const bool done = (this->*transition.callback)(state_) == CallbackReturn::SUCCESS;
      if (done) state_ = State(transition.to);
      return state_;
    }
    rclcpp::fake::fail("no " + name + " of a node that is " + state_.label());
    return state_;
  }

  State state_{"unconfigured"};
  std::vector<rclcpp::TimerBase::SharedPtr> timers_;
};

}  // namespace rclcpp_lifecycle
