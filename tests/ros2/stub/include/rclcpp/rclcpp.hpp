// rclcpp in one process: nodes with an executor each, topics, timers and a simulated clock.
// Written by hand for tests; what it accepts is less than what rclcpp accepts.
#pragma once

#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rclcpp/asking.hpp>
#include <rclcpp/middleware.hpp>
#include <rclcpp/parameters.hpp>
#include <rclcpp/qos.hpp>
#include <rclcpp/qos_overrides.hpp>
#include <rclcpp/time.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Which request a response is for.
struct rmw_request_id_t {
  rclcpp::fake::Ask ask;
  bool is_answered = false;
};

namespace rclcpp {

struct PreShutdownCallbackHandle {
  std::size_t index = 0;
};

/// That of all nodes, which are programs of their own only in name.
class Context {
 public:
  using SharedPtr = std::shared_ptr<Context>;
  PreShutdownCallbackHandle add_pre_shutdown_callback(std::function<void()> callback) {
    return {fake::middleware().before_shut_down(std::move(callback))};
  }
  bool remove_pre_shutdown_callback(const PreShutdownCallbackHandle& handle) {
    return fake::middleware().forget_before_shut_down(handle.index);
  }
};

inline void init(int /* argc */, const char* const* /* argv */) {}
inline bool ok() { return !fake::middleware().is_shut_down(); }
inline void shutdown() { fake::middleware().shut_down(); }

/// Lasts while what it does is wanted; when it goes, it no longer runs.
class JumpHandler {
 public:
  using SharedPtr = std::shared_ptr<JumpHandler>;
  explicit JumpHandler(std::function<void()> act) : jump_{fake::middleware().on_jump(act)} {}
  ~JumpHandler() { fake::middleware().forget_jump(jump_); }
  JumpHandler(const JumpHandler&) = delete;
  JumpHandler& operator=(const JumpHandler&) = delete;

 private:
  const std::size_t jump_;
};

class Clock {
 public:
  using SharedPtr = std::shared_ptr<Clock>;
  bool ros_time_is_active() const { return fake::middleware().is_simulated(); }
  JumpHandler::SharedPtr create_jump_callback(std::function<void()> before,
      std::function<void(const rcl_time_jump_t&)> after, const rcl_jump_threshold_t& threshold) {
    if (before || !threshold.on_clock_change || threshold.min_forward.nanoseconds != 1 ||
        threshold.min_backward.nanoseconds != -1) {
      throw std::invalid_argument("the stub tells of every jump, when it is over");
    }
    return std::make_shared<JumpHandler>([after] { after(rcl_time_jump_t()); });
  }
  Time now() const { return Time(fake::middleware().now(), RCL_ROS_TIME); }
  rcl_clock_type_t get_clock_type() const { return RCL_ROS_TIME; }
};

class Logger {
 public:
  explicit Logger(std::string name) : name_(std::move(name)) {}
  const char* get_name() const { return name_.c_str(); }

 private:
  std::string name_;
};

namespace fake {

/// What a process is told on its command line; each thread of the driver stands for a process.
struct Arguments {
  std::string name;
  std::map<std::string, std::string> remaps;
  std::map<std::string, ParameterValue> overrides;
  std::vector<std::pair<double, std::string>> changes;  // of the life cycle, after seconds
};

inline Arguments& arguments() {
  thread_local Arguments of_this_process;
  return of_this_process;
}

}  // namespace fake

class NodeOptions {};

template <class M>
class Publisher {
 public:
  using SharedPtr = std::shared_ptr<Publisher>;
  explicit Publisher(std::shared_ptr<fake::Writer> writer) : writer_(std::move(writer)) {}

  void publish(const M& message) const {
    std::ostringstream text;
    to_flow_style_yaml(message, text);
    writer_->write(std::make_shared<const M>(message), text.str());
  }
  const char* get_topic_name() const { return writer_->topic().c_str(); }
  std::size_t get_subscription_count() const { return writer_->matched(); }

 private:
  std::shared_ptr<fake::Writer> writer_;
};

template <class M>
class Subscription {
 public:
  using SharedPtr = std::shared_ptr<Subscription>;
  explicit Subscription(std::shared_ptr<fake::Reader> reader) : reader_(std::move(reader)) {}
  ~Subscription() { reader_->executor->changes("a subscription is destroyed"); }
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;
  const char* get_topic_name() const { return reader_->topic.c_str(); }

 private:
  std::shared_ptr<fake::Reader> reader_;
};

class TopicEndpointInfo {
 public:
  TopicEndpointInfo(std::string node, QoS qos) : node_(std::move(node)), qos_(qos) {}
  const std::string& node_name() const { return node_; }
  const QoS& qos_profile() const { return qos_; }

 private:
  std::string node_;
  QoS qos_;
};

class TimerBase;

/// What offers a service; the driver calls it.
template <class S>
class Service {
 public:
  using SharedPtr = std::shared_ptr<Service<S>>;
  explicit Service(std::shared_ptr<fake::Executor> executor) : executor_(std::move(executor)) {}
  ~Service() { executor_->changes("a service is destroyed"); }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  void send_response(rmw_request_id_t& id, typename S::Response& response) {
    if (id.is_answered) fake::fail("a request is answered twice");
    id.is_answered = true;
    fake::tell(id.ask, "response", fake::yaml(response));
  }

 private:
  const std::shared_ptr<fake::Executor> executor_;
};

class Node {
 public:
  using SharedPtr = std::shared_ptr<Node>;

  template <class Period>
  std::shared_ptr<TimerBase> create_wall_timer(Period period, std::function<void()> callback);

  template <class S, class Callback>
  std::shared_ptr<Service<S>> create_service(const std::string& name, Callback callback) {
    const std::function<void(std::shared_ptr<Service<S>>, std::shared_ptr<rmw_request_id_t>,
        std::shared_ptr<typename S::Request>)>
        taken = callback;
    executor_->changes("a service is made");
    const auto service = std::make_shared<Service<S>>(executor_);
    const std::weak_ptr<Service<S>> weak = service;
    const auto take = [weak, taken, executor = executor_](const fake::Ask& ask) {
      executor->post([weak, taken, ask] {
        const auto id = std::make_shared<rmw_request_id_t>(rmw_request_id_t{ask, false});
        const auto held = weak.lock();
        if (held) taken(held, id, fake::read<typename S::Request>(ask.fields));
      });
    };
    fake::offers().add(resolve_topic_name(name), weak, take);
    return service;
  }

  explicit Node(const std::string& name, const NodeOptions& /* options */ = NodeOptions())
      : arguments_(fake::arguments()), name_(arguments_.name.empty() ? name : arguments_.name) {
    if (fake::middleware().is_shut_down()) throw exceptions::RCLError("the context is not valid");
    fake::middleware().add(executor_);
  }
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  const char* get_name() const { return name_.c_str(); }
  const char* get_fully_qualified_name() const { return full_name_.c_str(); }
  Time now() const { return clock_->now(); }
  Clock::SharedPtr get_clock() { return clock_; }
  const Node* get_node_base_interface() const { return this; }
  const Node* get_node_topics_interface() const { return this; }
  std::string resolve_topic_name(const std::string& topic) const {
    const auto remap = arguments_.remaps.find(topic);
    const std::string& name = remap == arguments_.remaps.end() ? topic : remap->second;
    if (name.rfind("~/", 0) == 0) return "/" + name_ + name.substr(1);
    return name.front() == '/' ? name : "/" + name;
  }
  Context::SharedPtr get_context() const { return std::make_shared<Context>(); }
  Logger get_logger() const { return Logger(name_); }
  const std::shared_ptr<fake::Executor>& fake_executor() const { return executor_; }

  template <class M>
  std::shared_ptr<Publisher<M>> create_publisher(const std::string& topic, const QoS& qos,
      const PublisherOptions& options = PublisherOptions()) {
    const std::string name = resolve_topic_name(topic);
    const QoS asked =
        overridden(name + ".publisher.", qos, options.qos_overriding_options, true);
    return std::make_shared<Publisher<M>>(fake::middleware().writer(name, asked));
  }

  template <class M, class Callback>
  std::shared_ptr<Subscription<M>> create_subscription(
      const std::string& topic, const QoS& qos, Callback callback,
      const SubscriptionOptions& options = SubscriptionOptions()) {
    static_assert(std::is_invocable_v<Callback, std::shared_ptr<const M>>);
    const std::string name = resolve_topic_name(topic);
    const QoS asked =
        overridden(name + ".subscription.", qos, options.qos_overriding_options, false);
    const auto reader = std::make_shared<fake::Reader>(
        name, name_, asked, executor_, [callback](const fake::Data& data) {
          callback(std::static_pointer_cast<const M>(data));
        });
    fake::middleware().add(reader);
    return std::make_shared<Subscription<M>>(reader);
  }

  template <class T>
  T declare_parameter(const std::string& name, const T& value,
      const rcl_interfaces::msg::ParameterDescriptor& /* descriptor */ =
          rcl_interfaces::msg::ParameterDescriptor()) {
    return declared(name, ParameterValue(value)).template get<T>();
  }
  bool has_parameter(const std::string& name) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return declared_.count(name) > 0;
  }
  Parameter get_parameter(const std::string& name) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return Parameter(name, declared_.at(name));
  }

  std::vector<TopicEndpointInfo> get_subscriptions_info_by_topic(const std::string& topic) const {
    std::vector<TopicEndpointInfo> found;
    for (const auto& reader : fake::middleware().readers(topic)) {
      found.emplace_back(reader->node, reader->qos);
    }
    return found;
  }

 private:
  QoS overridden(const std::string& entity, QoS qos, const QosOverridingOptions& options,
      bool is_published) {
    for (const QosPolicyKind kind : options.get_policy_kinds()) {
      if (kind == QosPolicyKind::Lifespan && !is_published) continue;
      const std::string name = "qos_overrides." + entity + fake::name_of(kind);
      const ParameterValue value = has_parameter(name)
          ? get_parameter(name).get_parameter_value()
          : declared(name, fake::value_of(kind, qos));
      fake::set(kind, value, qos);
    }
    const QosCallback& check = options.get_validation_callback();
    if (!check) return qos;
    const QosCallbackResult result = check(qos);
    if (result.successful) return qos;
    throw exceptions::InvalidQosOverridesException("validation callback failed: " + result.reason);
  }

  ParameterValue declared(const std::string& name, const ParameterValue& fallback) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (declared_.count(name) > 0) throw exceptions::ParameterAlreadyDeclaredException(name);
    const auto found = arguments_.overrides.find(name);
    const ParameterValue chosen = found == arguments_.overrides.end() ? fallback : found->second;
    if (!chosen.has_type_of(fallback)) throw exceptions::InvalidParameterTypeException(name);
    declared_.emplace(name, chosen);
    return chosen;
  }

  const fake::Arguments arguments_;
  const std::string name_;
  const std::string full_name_ = "/" + name_;
  const Clock::SharedPtr clock_ = std::make_shared<Clock>();
  const std::shared_ptr<fake::Executor> executor_ = std::make_shared<fake::Executor>();
  mutable std::mutex mutex_;
  std::map<std::string, ParameterValue> declared_;
};

class TimerBase {
 public:
  using SharedPtr = std::shared_ptr<TimerBase>;
  void cancel() { alarm_->cancelled = true; }
  ~TimerBase() {
    cancel();
    alarm_->executor->changes("a timer is destroyed");
  }
  std::shared_ptr<fake::Alarm> alarm_;
};

template <class NodeT, class Callback>
TimerBase::SharedPtr create_timer(
    NodeT node, const Clock::SharedPtr& /* clock */, const Duration& period, Callback callback) {
  node->fake_executor()->changes("a timer is made");
  const auto timer = std::make_shared<TimerBase>();
  const std::weak_ptr<TimerBase> weak = timer;
  timer->alarm_ = std::make_shared<fake::Alarm>(node->fake_executor(), [weak, callback] {
    const TimerBase::SharedPtr held = weak.lock();
    if (!held || held->alarm_->cancelled) return;
    if constexpr (std::is_invocable_v<Callback, TimerBase&>) {
      callback(*held);
    } else {
      callback();
    }
  });
  fake::middleware().set(timer->alarm_, period.nanoseconds());
  return timer;
}

template <class Period>
TimerBase::SharedPtr Node::create_wall_timer(Period period, std::function<void()> callback) {
  const std::chrono::duration<double> seconds = period;
  return create_timer(this, clock_, Duration::from_seconds(seconds.count()), std::move(callback));
}

inline void spin(const std::shared_ptr<Node>& node) {
  node->fake_executor()->run([] { return ok(); });
}

// The clock of the stub has begun before there is a node: nobody waits for it.
inline void spin_some(const std::shared_ptr<Node>& /* node */) {}

}  // namespace rclcpp

#define RCLCPP_ERROR(logger, ...) (static_cast<void>(logger), std::fprintf(stderr, __VA_ARGS__))
#define RCLCPP_ERROR_STREAM(logger, stream) RCLCPP_FAKE_LOG("ERROR", logger, stream)
#define RCLCPP_WARN_STREAM_THROTTLE(logger, clock, milliseconds, stream) \
  do {                                                                   \
    static_cast<void>((clock).now());                                    \
    static_cast<void>(milliseconds);                                     \
    RCLCPP_FAKE_LOG("WARN", logger, stream);                             \
  } while (false)
#define RCLCPP_WARN_STREAM(logger, stream) RCLCPP_FAKE_LOG("WARN", logger, stream)
#define RCLCPP_INFO_STREAM(logger, stream) RCLCPP_FAKE_LOG("INFO", logger, stream)
#define RCLCPP_FAKE_LOG(level, logger, stream)                               \
  do {                                                                       \
    std::ostringstream fake_text;                                            \
    fake_text << stream;                                                     \
    rclcpp::fake::middleware().log(level, (logger).get_name(), fake_text.str()); \
  } while (false)
