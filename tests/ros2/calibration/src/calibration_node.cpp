// What generated packages rely on in rclcpp, told by the rclcpp that this is built with: the stub
// and each real one have to tell the same (facts.txt).
#include <chrono>
#include <cstdint>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/header.hpp>
#include <std_msgs/msg/int32.hpp>

namespace {

using Int32 = std_msgs::msg::Int32;
using Strings = std::vector<std::string>;

template <class... Values>
void tell(const std::string& what, const Values&... values) {
  std::string line = "fact\t" + what + ":";
  ((line += std::string(" ") + values), ...);
  std::cout << line << std::endl;
}

std::string text(bool value) { return value ? "true" : "false"; }
std::string text(const char* value) { return value; }
template <class T, class = std::enable_if_t<std::is_arithmetic_v<T>>>
std::string text(T value) {
  return std::to_string(value);
}

// What kind of error an action ends in; the order is from special to general.
std::string outcome(const std::function<void()>& action) {
  try {
    action();
  } catch (const rclcpp::exceptions::ParameterAlreadyDeclaredException&) {
    return "ParameterAlreadyDeclaredException";
  } catch (const rclcpp::exceptions::InvalidParameterTypeException&) {
    return "InvalidParameterTypeException";
  } catch (const rclcpp::exceptions::InvalidQosOverridesException&) {
    return "InvalidQosOverridesException";
  } catch (const rclcpp::exceptions::RCLErrorBase&) {
    return "RCLErrorBase";
  } catch (const std::runtime_error&) {
    return "runtime_error";
  }
  return "none";
}

// --- values -------------------------------------------------------------------------------------

void tellTimes() {
  using rclcpp::Duration;
  using rclcpp::Time;
  static_assert(std::is_same_v<decltype(Time() - Time()), Duration>);
  static_assert(std::is_same_v<decltype(Time() - Duration(0, 0)), Time>);
  static_assert(std::is_same_v<decltype(Time() + Duration(0, 0)), Time>);
  static_assert(std::is_same_v<decltype(Duration(0, 0) * 2.0), Duration>);
  static_assert(std::is_same_v<decltype(Time().nanoseconds()), int64_t>);
  static_assert(std::is_convertible_v<Time, builtin_interfaces::msg::Time>);
  static_assert(!std::is_convertible_v<int64_t, Time>);
  for (const double seconds : {0.1, 0.29, 1.1, 2.3, -0.29, 1e9}) {
    tell("from_seconds", text(Duration::from_seconds(seconds).nanoseconds()));
  }
  tell("scaled", text((Duration(3, 1) * 0.5).nanoseconds()));
  tell("seconds", text(Duration(1, 500000000).seconds()), text(Time(2, 5).seconds()));
  tell("clock of a time", text(Time().get_clock_type() == RCL_SYSTEM_TIME));
  builtin_interfaces::msg::Time stamp;
  stamp.sec = 7;
  stamp.nanosec = 9;
  const Time read(stamp, RCL_ROS_TIME);
  tell("of a message", text(read.nanoseconds()),
      text(Time(stamp).get_clock_type() == RCL_ROS_TIME));
  const builtin_interfaces::msg::Time back = read + Duration(1, 1);
  tell("to a message", text(back.sec), text(back.nanosec));
  const Time zero(0, 0, RCL_ROS_TIME);
  const Time system(0, 0, RCL_SYSTEM_TIME);
  tell("times of two clocks", outcome([&] { static_cast<void>(zero < system); }),
      outcome([&] { static_cast<void>(zero - system); }),
      outcome([&] { static_cast<void>(zero == system); }));
  tell("times before 0", outcome([&] { static_cast<void>(zero - Duration(1, 0)); }),
      outcome([] { static_cast<void>(Time(-1, 0, RCL_ROS_TIME)); }),
      outcome([] { static_cast<void>(Time(int64_t{-1}, RCL_ROS_TIME)); }));
  stamp.sec = -7;
  tell("a message before 0", outcome([&] { static_cast<void>(Time(stamp, RCL_ROS_TIME)); }));
}

template <class Qualities>
void tellQualities(const std::string& name, const Qualities& qos) {
  const rclcpp::QoS& all = qos;
  tell(name, text(all.depth()), text(all.durability() == rclcpp::DurabilityPolicy::TransientLocal),
      text(all.reliability() == rclcpp::ReliabilityPolicy::Reliable));
}

void tellQualities() {
  static_assert(std::is_convertible_v<int, rclcpp::QoS>);
  tellQualities("QoS", rclcpp::QoS(100));
  tellQualities("KeepLast", rclcpp::QoS(rclcpp::KeepLast(1000)).reliable());
  tellQualities("transient local", rclcpp::QoS(1).transient_local());
  tellQualities("SensorDataQoS", rclcpp::SensorDataQoS());
}

// --- nodes --------------------------------------------------------------------------------------

rcl_interfaces::msg::ParameterDescriptor described() {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = "a parameter";
  descriptor.read_only = true;
  return descriptor;
}

void tellParameters(rclcpp::Node& node) {
  tell("has", text(node.has_parameter("mailbox.names")));
  node.declare_parameter<Strings>("mailbox.names", Strings{"a", "b"}, described());
  tell("has", text(node.has_parameter("mailbox.names")));
  const Strings names = node.get_parameter("mailbox.names").as_string_array();
  tell("as_string_array", text(names.size()), names.back());
  tell("declared again", outcome([&] { node.declare_parameter("mailbox.names", Strings{}); }));
  tell("overruled", text(node.declare_parameter<int>("whole", 1, described())),
      text(node.declare_parameter<double>("real", 1.0, described())),
      text(node.declare_parameter<bool>("truth", false, described())),
      node.declare_parameter<std::string>("name", "", described()));
  tell("int64", text(node.declare_parameter<int64_t>("wide", int64_t{1} << 40, described())));
  const std::vector<int64_t> grid{1};
  const auto found = node.declare_parameter("grid", grid, described());
  static_assert(std::is_same_v<std::decay_t<decltype(found)>, std::vector<int64_t>>);
  tell("array", text(found.size()), text(found.back()));
  tell("of a wrong type", outcome([&] { node.declare_parameter<int>("wrong", 1, described()); }),
      outcome([&] { node.declare_parameter<double>("rounded", 1.0, described()); }));
}

void tellTopics(rclcpp::Node& node) {
  const auto publisher = node.create_publisher<Int32>("~/own", rclcpp::QoS(3));
  static_assert(
      std::is_convertible_v<decltype(publisher), rclcpp::Publisher<Int32>::SharedPtr>);
  for (const char* const topic : {"plain", "~/own", "~/moved", "/whole"}) {
    tell(topic, text(node.create_publisher<Int32>(topic, rclcpp::QoS(3))->get_topic_name()));
  }
  const auto hear = [](Int32::ConstSharedPtr) {};
  const auto kept = rclcpp::QoS(4).transient_local();
  const rclcpp::Subscription<Int32>::SharedPtr one =
      node.create_subscription<Int32>("~/own", rclcpp::QoS(7), hear);
  const auto two = node.create_subscription<Int32>("~/own", kept, hear);
  tell("subscribed", text(one->get_topic_name()), text(two->get_topic_name()));
  const auto list = [&] {
    return node.get_subscriptions_info_by_topic(publisher->get_topic_name()).size();
  };
  // Each asks at once: the stub takes a thread that sleeps for one that waits for what comes.
  for (int i = 0; i < 300 && (list() < 2 || publisher->get_subscription_count() < 1); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  // The one that asks for what was sent before it is listed, and does not match.
  tell("listed", text(list()), "matched", text(publisher->get_subscription_count()));
  std::size_t lasting = 0;
  for (const auto& endpoint : node.get_subscriptions_info_by_topic("/told/own")) {
    tell("of node", endpoint.node_name());
    const auto durability = endpoint.qos_profile().durability();
    lasting += durability == rclcpp::DurabilityPolicy::TransientLocal ? 1U : 0U;
  }
  tell("transient local ones", text(lasting));
}

// Which of the parameters qos_overrides./told/... count, and what a callback refuses.
void tellOverrides(rclcpp::Node& node) {
  using Policy = rclcpp::QosPolicyKind;
  rclcpp::SubscriptionOptions every;
  every.qos_overriding_options = rclcpp::QosOverridingOptions({Policy::Reliability,
      Policy::Durability, Policy::History, Policy::Depth, Policy::Deadline, Policy::Lifespan,
      Policy::Liveliness, Policy::LivelinessLeaseDuration, Policy::AvoidRosNamespaceConventions});
  const auto hear = [](Int32::ConstSharedPtr) {};
  const auto first =
      node.create_subscription<Int32>("~/quality", rclcpp::SensorDataQoS(), hear, every);
  const auto list = [&] { return node.get_subscriptions_info_by_topic("/told/quality"); };
  for (int i = 0; i < 300 && list().empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  for (const auto& endpoint : list()) {
    const auto reliability = endpoint.qos_profile().reliability();
    tell("overridden", text(reliability == rclcpp::ReliabilityPolicy::Reliable));
  }
  tell("declared", text(node.has_parameter("qos_overrides./told/quality.subscription.deadline")),
      text(node.has_parameter("qos_overrides./told/quality.subscription.lifespan")));
  rclcpp::PublisherOptions checked;
  std::string seen;
  checked.qos_overriding_options =
      rclcpp::QosOverridingOptions::with_default_policies([&seen](const rclcpp::QoS& qos) {
        seen = text(qos.depth()) + " " + text(qos.history() == rclcpp::HistoryPolicy::KeepAll);
        rclcpp::QosCallbackResult result;
        result.successful = qos.depth() >= 10;
        result.reason = "too shallow";
        return result;
      });
  const auto make = [&](const std::string& topic) {
    return outcome([&] { node.create_publisher<Int32>(topic, rclcpp::QoS(10), checked); });
  };
  const std::string deep = make("~/deep");
  tell("a callback sees", seen, deep);
  tell("twice on a topic", make("~/deep"));
  const std::string shallow = make("~/shallow");
  tell("a callback refuses", seen, shallow);
  tell("resolved", node.get_node_topics_interface()->resolve_topic_name("~/moved"));
}

// --- what happens -------------------------------------------------------------------------------

// Asks its own executor for messages and timers, one after the other.
class Told : public rclcpp::Node {
 public:
  explicit Told(const rclcpp::NodeOptions& options) : Node("calibration", options) {
    tell("name", get_name());
    tellParameters(*this);
    tellTopics(*this);
    tellOverrides(*this);
    late_ = create_publisher<Int32>("~/late", rclcpp::QoS(2).transient_local());
    for (int32_t i = 1; i <= 3; ++i) publish(i);
    const auto lasting = rclcpp::QoS(10).transient_local();
    kept_ = create_subscription<Int32>("~/late", lasting, [this](Int32::ConstSharedPtr heard) {
      tell("kept", text(heard->data));
      count();
    });
    volatile_ = create_subscription<Int32>("~/late", rclcpp::QoS(10),
        [](Int32::ConstSharedPtr heard) { tell("not kept", text(heard->data)); });
    ticks_ = rclcpp::create_timer(this, get_clock(), rclcpp::Duration::from_seconds(0.3),
        [this](rclcpp::TimerBase& timer) { tick(timer); });
    gone_ = rclcpp::create_timer(this, get_clock(), rclcpp::Duration::from_seconds(0.1),
        [] { tell("a timer that is gone rang"); });
    gone_.reset();
  }

 private:
  void publish(int32_t value) {
    Int32 message;
    message.data = value;
    late_->publish(message);
  }

  void tick(rclcpp::TimerBase& timer) {
    tell("tick", text(++ticked_));
    if (ticked_ < 3) return;
    timer.cancel();
    count();
  }

  // Two kept messages and the last tick are what is waited for.
  void count() {
    if (++counted_ < 3) return;
    last_ = rclcpp::create_timer(
        this, get_clock(), rclcpp::Duration::from_seconds(1.0), [this] { end(); });
  }

  void end() {
    last_->cancel();
    RCLCPP_ERROR_STREAM(get_logger(), "an error of " << get_name());
    RCLCPP_WARN_STREAM_THROTTLE(get_logger(), *get_clock(), 1000, "a warning");
    tell("clock", text(now().get_clock_type() == RCL_ROS_TIME), text(rclcpp::ok()));
    rclcpp::shutdown();
    tell("shut down", text(rclcpp::ok()), outcome([this] { publish(4); }));
  }

  rclcpp::Publisher<Int32>::SharedPtr late_;
  rclcpp::Subscription<Int32>::SharedPtr kept_;
  rclcpp::Subscription<Int32>::SharedPtr volatile_;
  rclcpp::TimerBase::SharedPtr ticks_;
  rclcpp::TimerBase::SharedPtr gone_;
  rclcpp::TimerBase::SharedPtr last_;
  int ticked_ = 0;
  int counted_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  if (!rclcpp::ok()) return 0;
  tellTimes();
  tellQualities();
  rclcpp::spin(std::make_shared<Told>(rclcpp::NodeOptions()));
  tell("a node after the end", outcome([] { std::make_shared<rclcpp::Node>("late"); }));
  return 0;
}
