// See ../README.md.
#pragma once

#include <cstdio>
#include <iostream>
#include <rclcpp/parameters.hpp>
#include <rclcpp/time.hpp>
#include <rclcpp/world.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <type_traits>

namespace rclcpp {

using std::placeholders::_1;

struct KeepLast {
  explicit KeepLast(std::size_t depth_) : depth(depth_) {}
  std::size_t depth;
};

struct QoS {
  QoS(std::size_t depth_) : depth(depth_) {}
  QoS(const KeepLast& last) : depth(last.depth) {}
  QoS& reliable() { return *this; }
  QoS& best_effort() { return *this; }
  QoS& transient_local() { return *this; }
  QoS& keep_last(std::size_t depth_) {
    depth = depth_;
    return *this;
  }
  std::size_t depth;
};
struct SensorDataQoS : QoS {
  SensorDataQoS() : QoS(5) {}
};
struct ServicesQoS : QoS {
  ServicesQoS() : QoS(10) {}
};

struct MessageInfo {};

enum class CallbackGroupType { MutuallyExclusive, Reentrant };
struct CallbackGroup {
  using SharedPtr = std::shared_ptr<CallbackGroup>;
  std::shared_ptr<fake::Group> group = std::make_shared<fake::Group>();
};

struct SubscriptionOptions {
  CallbackGroup::SharedPtr callback_group;
};
struct PublisherOptions {};

struct Logger {};
inline Logger get_logger(const std::string&) { return {}; }

class NodeOptions {
 public:
  NodeOptions& use_intra_process_comms(bool) { return *this; }
  NodeOptions& allow_undeclared_parameters(bool) { return *this; }
};

inline int shown(double value) { return static_cast<int>(value); }
inline int shown(const std::string& value) { return static_cast<int>(value.size()); }

template <class M>
class LoanedMessage {
 public:
  M& get() { return *message_; }
  bool is_valid() const { return true; }
  std::unique_ptr<M> message_ = std::make_unique<M>();
};

template <class M>
class Publisher {
 public:
  using SharedPtr = std::shared_ptr<Publisher>;
  using UniquePtr = std::unique_ptr<Publisher>;
  explicit Publisher(std::string topic) : topic_(std::move(topic)) {}
  void publish(const M& message) { send(std::make_shared<const M>(message)); }
  void publish(std::unique_ptr<M> message) { send(std::shared_ptr<const M>(std::move(message))); }
  void publish(LoanedMessage<M>&& message) { publish(std::move(message.message_)); }
  LoanedMessage<M> borrow_loaned_message() { return {}; }
  std::size_t get_subscription_count() const { return 1; }
  const char* get_topic_name() const { return topic_.c_str(); }

 private:
  void send(const std::shared_ptr<const M>& message) {
    if (fake::world().shut_down) return;
    if constexpr (std::is_same_v<decltype(message_data(*message, 0)), int>) {
      fake::world().sent.emplace_back(topic_, message_data(*message, 0));
    }
    fake::world().publish<M>(topic_, message);
  }
  template <class T>
  static auto message_data(const T& m, int) -> decltype(shown(m.data)) { return shown(m.data); }
  template <class T>
  static int message_data(const T&, long) { return 0; }
  std::string topic_;
};

struct SubscriptionBase {
  using SharedPtr = std::shared_ptr<SubscriptionBase>;
  std::shared_ptr<fake::Reader> reader;
};
template <class M>
struct Subscription : SubscriptionBase {
  using SharedPtr = std::shared_ptr<Subscription>;
};

class TimerBase : public std::enable_shared_from_this<TimerBase> {
 public:
  using SharedPtr = std::shared_ptr<TimerBase>;
  using WeakPtr = std::weak_ptr<TimerBase>;
  TimerBase(int64_t period, const void* node, std::shared_ptr<fake::Group> group)
      : period_(period), node_(node), group_(std::move(group)) {}
  void cancel() { cancelled_ = true; }
  bool is_canceled() const { return cancelled_; }
  void reset() {
    cancelled_ = false;
    arm(fake::world().now + period_);
  }
  void arm(int64_t due) {
    const int number = ++armed_;
    due_ = due;
    const std::weak_ptr<TimerBase> weak = shared_from_this();
    fake::world().at(due, node_, group_, [weak, number] {
      const auto held = weak.lock();
      if (!held || held->cancelled_ || number != held->armed_) return;
      const int64_t period = std::max<int64_t>(held->period_, 1);
      int64_t next = held->due_ + period;
      while (next < fake::world().now) next += period;
      held->arm(next);
      held->callback_(*held);
    });
  }
  std::function<void(TimerBase&)> callback_;

 private:
  int64_t period_;
  const void* node_;
  std::shared_ptr<fake::Group> group_;
  int64_t due_ = 0;
  int armed_ = 0;
  bool cancelled_ = false;
};
using WallTimer = TimerBase;

template <class S>
class Service {
 public:
  using SharedPtr = std::shared_ptr<Service>;
};

enum class FutureReturnCode { SUCCESS, INTERRUPTED, TIMEOUT };

template <class S>
class Client {
 public:
  using SharedPtr = std::shared_ptr<Client>;
  using Request = std::shared_ptr<typename S::Request>;
  using Response = std::shared_ptr<typename S::Response>;
  using SharedFuture = std::shared_future<Response>;
  struct FutureAndRequestId {
    SharedFuture future;
    int64_t request_id = 0;
    Response get() { return future.get(); }
    bool valid() const { return future.valid(); }
    SharedFuture share() { return future; }
    template <class D>
    std::future_status wait_for(const D& span) const {
      auto& world = fake::world();
      const int64_t until = world.now + Duration(span).nanoseconds();
      const auto ready = [this] { return future.wait_for(std::chrono::seconds(0)); };
      while (world.parallel && ready() != std::future_status::ready && world.step(until)) continue;
      if (ready() != std::future_status::ready) world.sleep(until - world.now);
      return ready();
    }
    operator SharedFuture() const { return future; }
  };
  Client(std::string name, const void* node, std::shared_ptr<fake::Group> group)
      : name_(std::move(name)), node_(node), group_(std::move(group)) {}

  FutureAndRequestId async_send_request(const Request& request) {
    return async_send_request(request, [](SharedFuture) {});
  }
  template <class F>
  FutureAndRequestId async_send_request(const Request& request, F callback) {
    const auto promise = std::make_shared<std::promise<Response>>();
    const SharedFuture future = promise->get_future().share();
    const auto answered = [=, node = node_, group = group_](std::shared_ptr<void> response) {
      fake::world().at(fake::world().now, node, group, [=] {
        promise->set_value(std::static_pointer_cast<typename S::Response>(response));
        callback(future);
      });
    };
    const auto found = fake::world().services.find(name_);
    if (found != fake::world().services.end()) found->second(request, answered);
    return {future};
  }
  template <class R = int64_t, class P = std::milli>
  bool wait_for_service(std::chrono::duration<R, P> = std::chrono::duration<R, P>(-1)) const {
    return service_is_ready();
  }
  bool service_is_ready() const { return fake::world().services.count(name_) > 0; }

 private:
  std::string name_;
  const void* node_;
  std::shared_ptr<fake::Group> group_;
};

class Node : public std::enable_shared_from_this<Node> {
 public:
  using SharedPtr = std::shared_ptr<Node>;
  explicit Node(std::string name, const NodeOptions& = NodeOptions()) : name_(std::move(name)) {}
  Node(std::string name, const std::string&, const NodeOptions& = NodeOptions()) : name_(std::move(name)) {}
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  static SharedPtr make_shared(const std::string& name) { return std::make_shared<Node>(name); }

  const char* get_name() const { return name_.c_str(); }
  Logger get_logger() const { return {}; }
  Time now() const { return clock_->now(); }
  Clock::SharedPtr get_clock() const { return clock_; }
  const void* get_node_base_interface() const { return this; }

  CallbackGroup::SharedPtr create_callback_group(CallbackGroupType type) {
    const auto made = std::make_shared<CallbackGroup>();
    if (type == CallbackGroupType::Reentrant) made->group->exclusion = fake::Exclusion::none;
    return made;
  }

  template <class M>
  std::shared_ptr<Publisher<M>> create_publisher(const std::string& topic, const QoS&) {
    return std::make_shared<Publisher<M>>(topic);
  }

  template <class M, class F>
  std::shared_ptr<Subscription<M>> create_subscription(const std::string& topic, const QoS& qos,
      F callback, const SubscriptionOptions& options = SubscriptionOptions()) {
    const auto found = std::make_shared<Subscription<M>>();
    found->reader = std::make_shared<fake::Reader>();
    *found->reader = {this, group(options.callback_group), qos.depth,
        [callback](const std::shared_ptr<const void>& data) mutable {
          deliver<M>(callback, std::static_pointer_cast<const M>(data));
        }, {}};
    fake::world().readers[topic].push_back(found->reader);
    return found;
  }

  template <class R, class P, class F>
  TimerBase::SharedPtr create_wall_timer(const std::chrono::duration<R, P>& period, F callback,
      const CallbackGroup::SharedPtr& chosen = nullptr, bool autostart = true) {
    const auto timer = std::make_shared<TimerBase>(Duration(period).nanoseconds(), this, group(chosen));
    timer->callback_ = [callback](TimerBase& own) mutable {
      if constexpr (std::is_invocable_v<F, TimerBase&>) callback(own);
      else callback();
    };
    if (autostart) timer->reset();
    else timer->cancel();
    return timer;
  }
  template <class R, class P, class F>
  TimerBase::SharedPtr create_timer(const std::chrono::duration<R, P>& period, F callback,
      const CallbackGroup::SharedPtr& chosen = nullptr) {
    return create_wall_timer(period, callback, chosen);
  }

  template <class S, class F>
  std::shared_ptr<Service<S>> create_service(const std::string& name, F callback) {
    using Req = std::shared_ptr<typename S::Request>;
    using Res = std::shared_ptr<typename S::Response>;
    fake::world().services[name] = [=](const std::shared_ptr<void>& request, const auto& answered) {
      fake::world().at(fake::world().now, this, group_.group, [=] {
        const Res response = std::make_shared<typename S::Response>();
        const Req asked = std::static_pointer_cast<typename S::Request>(request);
        callback(asked, response);
        answered(response);
      });
    };
    return std::make_shared<Service<S>>();
  }
  template <class S>
  std::shared_ptr<Client<S>> create_client(const std::string& name, const QoS& = QoS(10),
      const CallbackGroup::SharedPtr& chosen = nullptr) {
    return std::make_shared<Client<S>>(name, this, group(chosen));
  }

  template <class T>
  auto declare_parameter(const std::string& name, const T& value,
      const rcl_interfaces::msg::ParameterDescriptor& = rcl_interfaces::msg::ParameterDescriptor()) {
    parameters_[name] = Parameter(name, value);
    if constexpr (std::is_convertible_v<T, std::string>) return std::string(value);
    else return value;
  }
  bool has_parameter(const std::string& name) const { return parameters_.count(name) > 0; }
  Parameter get_parameter(const std::string& name) const { return parameters_.at(name); }
  template <class T>
  bool get_parameter(const std::string& name, T& variable) const {
    if (!has_parameter(name)) return false;
    variable = parameters_.at(name).get_value<T>();
    return true;
  }
  template <class T>
  bool get_parameter_or(const std::string& name, T& variable, const T& otherwise) const {
    if (get_parameter(name, variable)) return true;
    variable = otherwise;
    return false;
  }
  rcl_interfaces::msg::SetParametersResult set_parameter(const Parameter& parameter) {
    for (const auto& weak : on_set_) {
      const auto held = weak.lock();
      if (!held) continue;
      const auto result = held->callback({parameter});
      if (!result.successful) return result;
    }
    parameters_[parameter.get_name()] = parameter;
    for (const auto& weak : post_set_) {
      if (const auto held = weak.lock()) held->callback({parameter});
    }
    return {true, ""};
  }
  node_interfaces::OnSetParametersCallbackHandle::SharedPtr add_on_set_parameters_callback(OnSet callback) {
    const auto handle = std::make_shared<node_interfaces::OnSetParametersCallbackHandle>();
    handle->callback = std::move(callback);
    on_set_.push_back(handle);
    return handle;
  }
  node_interfaces::PostSetParametersCallbackHandle::SharedPtr add_post_set_parameters_callback(
      std::function<void(const std::vector<Parameter>&)> callback) {
    const auto handle = std::make_shared<node_interfaces::PostSetParametersCallbackHandle>();
    handle->callback = std::move(callback);
    post_set_.push_back(handle);
    return handle;
  }

 private:
  std::shared_ptr<fake::Group> group(const CallbackGroup::SharedPtr& chosen) const {
    return chosen ? chosen->group : group_.group;
  }
  template <class M, class F>
  static void deliver(F& callback, const std::shared_ptr<const M>& message) {
    if constexpr (std::is_invocable_v<F, std::shared_ptr<const M>>) callback(message);
    else if constexpr (std::is_invocable_v<F, std::shared_ptr<M>>) callback(std::make_shared<M>(*message));
    else if constexpr (std::is_invocable_v<F, std::unique_ptr<M>>) callback(std::make_unique<M>(*message));
    else if constexpr (std::is_invocable_v<F, const M&, const MessageInfo&>) callback(*message, MessageInfo());
    else callback(*message);
  }

  std::string name_;
  Clock::SharedPtr clock_ = std::make_shared<Clock>();
  CallbackGroup group_;
  std::map<std::string, Parameter> parameters_;
  std::vector<std::weak_ptr<node_interfaces::OnSetParametersCallbackHandle>> on_set_;
  std::vector<std::weak_ptr<node_interfaces::PostSetParametersCallbackHandle>> post_set_;
};

template <class N, class F>
TimerBase::SharedPtr create_timer(N node, const Clock::SharedPtr&, const Duration& period, F callback) {
  return node->create_wall_timer(std::chrono::nanoseconds(period.nanoseconds()), callback);
}

inline void init(int, char**) {}
inline bool ok() { return fake::world().ok(); }
inline void shutdown() {
  auto& world = fake::world();
  if (world.shut_down) return;
  world.shut_down = true;
  for (const auto& callback : std::vector<std::function<void()>>(world.on_shutdown)) callback();
}
inline void on_shutdown(const std::function<void()>& callback) {
  fake::world().on_shutdown.push_back(callback);
}

namespace executors {

class SingleThreadedExecutor {
 public:
  virtual ~SingleThreadedExecutor() = default;
  void add_node(const std::shared_ptr<Node>& node) { add(node.get()); }
  void remove_node(const std::shared_ptr<Node>& node) { nodes_.erase(node.get()); }
  void cancel() { cancelled_ = true; }
  void spin() {
    cancelled_ = false;
    run([] { return false; }, fake::world().end);
  }
  void spin_some(std::chrono::nanoseconds = std::chrono::nanoseconds(0)) {
    run([] { return false; }, fake::world().now);
  }
  void spin_once(std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) {
    const int64_t until = limit(timeout);
    bool served = false;
    run([&served] { return std::exchange(served, true); }, until);
  }
  template <class F>
  FutureReturnCode spin_until_future_complete(const F& future,
      std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) {
    const auto complete = [&future] {
      return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    };
    run(complete, limit(timeout));
    return complete() ? FutureReturnCode::SUCCESS : FutureReturnCode::TIMEOUT;
  }
  void add(const void* node) { nodes_.insert(node); }

 protected:
  virtual bool parallel() const { return false; }

 private:
  static int64_t limit(std::chrono::nanoseconds timeout) {
    auto& world = fake::world();
    return timeout.count() < 0 ? world.end : std::min(world.end, world.now + timeout.count());
  }
  // Serves until something is so, or a time; then that is the time.
  template <class Done>
  void run(Done done, int64_t until) {
    auto& world = fake::world();
    const auto spun = std::exchange(world.spun, nodes_);
    const bool parallel_before = std::exchange(world.parallel, parallel());
    bool over = false;
    while (!cancelled_ && !world.shut_down && !over) {
      over = done();
      if (!over && !world.step(until)) {
        world.now = std::max(world.now, until);
        over = true;
      }
    }
    world.spun = spun;
    world.parallel = parallel_before;
  }
  std::set<const void*> nodes_;
  bool cancelled_ = false;
};

class MultiThreadedExecutor : public SingleThreadedExecutor {
 public:
  bool parallel() const override { return true; }
};
using StaticSingleThreadedExecutor = SingleThreadedExecutor;

}  // namespace executors

inline void spin(const std::shared_ptr<Node>& node) {
  executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  executor.spin();
}
inline void spin_some(const std::shared_ptr<Node>& node) {
  executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  executor.spin_some();
}
template <class F>
FutureReturnCode spin_until_future_complete(const std::shared_ptr<Node>& node, const F& future,
    std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) {
  executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  return executor.spin_until_future_complete(future, timeout);
}

}  // namespace rclcpp

#define RCLCPP_DEBUG(...) ((void)0)
#define RCLCPP_INFO(...) ((void)0)
#define RCLCPP_WARN(...) ((void)0)
#define RCLCPP_ERROR(...) ((void)0)
#define RCLCPP_INFO_STREAM(...) ((void)0)
