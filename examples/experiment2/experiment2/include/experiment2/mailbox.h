// The mailbox of a rebec: serves its messages one by one, in the model's order and time.
#ifndef EXPERIMENT2_MAILBOX_H
#define EXPERIMENT2_MAILBOX_H

#include <ros/ros.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/optional.hpp>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <map>
#include <mutex>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "experiment2/startup.h"
#include "experiment2/values.h"
#include "experiment2/watchdog.h"

namespace experiment2 {

constexpr uint32_t kQueueSize = 1000;
constexpr double kRounded = 1e-6;  // units of model time, more than what division loses
constexpr double kFarAway = 1e9;  // s, still a valid ros::Duration

/// A body that has run: what it served, when that arrived, was taken and ended.
struct Served {
  std::string server;
  std::string arguments;
  int64_t arrival;
  int64_t start;
  int64_t now;
};

/// Publishers to every rebec that a variable of the model may stand for, by name.
using Publishers = std::map<std::string, ros::Publisher>;

inline const ros::Publisher& to(const Publishers& publishers, const std::string& rebec) {
  const auto found = publishers.find(rebec);
  if (found == publishers.end()) throw Violation("null", "no rebec '" + rebec + "'");
  return found->second;
}

namespace detail {

template <class T>
void read(XmlRpc::XmlRpcValue& from, T& value) {
  const bool is_double = from.getType() == XmlRpc::XmlRpcValue::TypeDouble;
  value = static_cast<T>(is_double ? static_cast<double>(from) : static_cast<int>(from));
}

inline void read(XmlRpc::XmlRpcValue& from, bool& value) { value = static_cast<bool>(from); }

template <class T, std::size_t size>
void read(XmlRpc::XmlRpcValue& from, std::array<T, size>& values) {
  for (int i = 0; i < static_cast<int>(size) && i < from.size(); ++i) {
    read(from[i], values[static_cast<std::size_t>(i)]);
  }
}

}  // namespace detail

/// Tells the constructor of a base class that a derived class constructs the rebec.
struct Inherited {};

/// Reads a constant of the model that is an array; what the parameter server lacks stays.
template <class T, std::size_t size>
void readArray(const ros::NodeHandle& node, const std::string& key, std::array<T, size>& values) {
  XmlRpc::XmlRpcValue list;
  if (node.getParam(key, list)) detail::read(list, values);
}

class Mailbox {
 public:
  using Body = std::function<void()>;

  /// `best_priority` is that of the most urgent server of the class.
  Mailbox(const ros::NodeHandle& node, std::size_t capacity, int best_priority = kNoPriority)
      : node_(node),
        self_(lastSegment(ros::this_node::getName())),
        capacity_(capacity),
        best_priority_(best_priority),
        slack_(ros::NodeHandle("mailbox").param("slack", 0.5)),
        startup_(self_),
        watchdog_(startup_, slack_, [this] { return look(); }) {
    const ros::NodeHandle options("mailbox");
    time_unit_ = options.param("time_unit", 1.0);
    settle_ = ros::Duration(options.param("settle", 0.05));
    random_.seed(static_cast<uint32_t>(options.param("seed", 0)) ^ hash(self_));
  }

  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  ~Mailbox() { stop(); }

  /// A publisher to another rebec, on a private topic that the launch file remaps.
  template <class M>
  ros::Publisher advertise(const std::string& topic) {
    const std::string name = node_.resolveName(topic);
    startup_.expectSubscriber(name);
    return node_.advertise<M>(topic, kQueueSize,
        [this, name](const ros::SingleSubscriberPublisher& subscriber) {
          startup_.addSubscriber(name, subscriber.getSubscriberName());
        });
  }

  /// Publishers to all rebecs of a class, which the launch file lists.
  template <class M>
  Publishers advertiseAll(const std::string& class_name, const std::string& server) {
    Publishers publishers;
    for (const std::string& rebec : rebecsOf(class_name)) {
      publishers[rebec] = advertise<M>(class_name + "/" + rebec + "/" + server);
    }
    return publishers;
  }

  /// Whether a rebec is of a class or of one that extends it.
  bool isA(const std::string& rebec, const std::string& class_name) const {
    const std::vector<std::string> rebecs = rebecsOf(class_name);
    return std::find(rebecs.begin(), rebecs.end(), rebec) != rebecs.end();
  }

  /// A reliable, deep subscription that hands every message to `object`.
  template <class M, class T>
  ros::Subscriber subscribe(const std::string& topic,
      void (T::*shim)(const boost::shared_ptr<const M>&), T* object) {
    return node_.subscribe(topic, kQueueSize, shim, object, ros::TransportHints().tcpNoDelay());
  }

  /// The same for a controller, whose topics are below control_bridge.
  template <class M, class T>
  ros::Subscriber subscribeOnBridge(const std::string& server,
      void (T::*shim)(const boost::shared_ptr<const M>&), T* object) {
    return subscribe(ros::names::resolve("control_bridge/" + self_ + "/" + server), shim, object);
  }

  /// Sends to another rebec; what is sent before time 0 goes out at time 0.
  template <class M>
  void publish(const ros::Publisher& publisher, M message, const When& when) {
    message.timing = when.from(now_);
    atStart([this, publisher, message]() mutable {
      message.timing = later(message.timing);
      publisher.publish(message);
    });
  }

  /// Sends to the rebec itself.
  void post(const Server& server, const When& when, std::string arguments, Body serve) {
    const bool early = !started_;
    add({server, when.from(now_), self_, std::move(arguments), std::move(serve), {}, 0, early});
  }

  /// Takes in what another rebec sent.
  void receive(const Server& server, const Timing& timing, std::string sender,
      std::string arguments, Body serve) {
    // What is sent in one go may come in any order: give a more urgent message time to come too.
    const bool overtakable = server.priority > best_priority_;
    const ros::Time earliest = overtakable ? ros::Time::now() + settle_ : ros::Time();
    add({server, timing, std::move(sender), std::move(arguments), std::move(serve), earliest, 0,
        false});
  }

  int32_t now() const { return static_cast<int32_t>(now_); }
  int32_t arrival() const { return static_cast<int32_t>(current_.timing.arrival); }
  int32_t expiry() const {
    return static_cast<int32_t>(std::min<int64_t>(current_.timing.deadline, INT32_MAX));
  }
  int32_t waitingTime() const { return static_cast<int32_t>(start_ - current_.timing.arrival); }
  const std::string& sender() const { return current_.sender; }
  const std::string& self() const { return self_; }

  /// Keeps the rebec busy; ends early, by an exception, only when the node shuts down.
  void delay(int32_t time) {
    if (time < 0) throw Violation("time", "delay " + std::to_string(time));
    const int64_t start = now_;
    now_ += time;
    atStart([this, start, time] { on_delay_(start + shift_, time); });
    if (!started_) return;
    delaying_ = true;
    sleepUntil(at(static_cast<double>(now_)));
    delaying_ = false;
    ++steps_;
  }

  template <class T>
  T choose(std::initializer_list<T> choices) {
    std::uniform_int_distribution<std::size_t> index(0, choices.size() - 1);
    return choices.begin()[index(random_)];
  }

  /// What a sensor has seen, if it is one of the choices that the model allows.
  template <class T>
  T choose(std::initializer_list<T> choices, const boost::optional<T>& seen) {
    if (!seen) return choose(choices);
    if (std::find(choices.begin(), choices.end(), *seen) != choices.end()) return *seen;
    report("choice", current_.server, text(*seen) + " is outside the choices");
    return choose(choices);
  }

  void assertion(bool holds, const std::string& claim = "does not hold") const {
    if (!holds) report("assertion", current_.server, claim);
  }

  void onServed(std::function<void(const Served&)> observer) { on_served_ = std::move(observer); }
  void onDelay(std::function<void(int64_t, int32_t)> observer) { on_delay_ = std::move(observer); }
  void onEnd(std::function<void(int64_t)> observer) { on_end_ = std::move(observer); }

  /// The moment on the ROS clock that a logical time stands for.
  ros::Time at(double time) const {
    return zero_ + ros::Duration(std::min(time * time_unit_, kFarAway));
  }
  double timeUnit() const { return time_unit_; }

  /// Has a thread of its own look at something a few times a second; call it before start().
  void watch(Body check) { watchdog_.addCheck(std::move(check)); }

  /// Runs the constructor of the model; call it before start().
  void construct(const Body& body) { perform(body); }

  void start() {
    thread_ = std::thread(&Mailbox::run, this);
    watchdog_.start();
  }

  void stop() {
    watchdog_.stop();
    startup_.stop();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
  }

 private:
  struct Message {
    Server server;
    Timing timing;
    std::string sender;
    std::string arguments;
    Body serve;
    ros::Time earliest;
    uint64_t receipt;
    bool early;  // its times count from the moment from which this rebec serves
  };

  static std::vector<std::string> rebecsOf(const std::string& class_name) {
    return ros::NodeHandle().param("mailbox/instances/" + class_name, std::vector<std::string>());
  }

  static std::string lastSegment(const std::string& name) {
    return name.substr(name.rfind('/') + 1);
  }

  static uint32_t hash(const std::string& name) {
    uint32_t value = 2166136261U;  // FNV-1a, the same on every machine
    for (const char c : name) value = (value ^ static_cast<uint8_t>(c)) * 16777619U;
    return value;
  }

  static bool goesBefore(const Message& a, const Message& b) {
    return std::tie(a.timing.arrival, a.server.priority, a.receipt) <
           std::tie(b.timing.arrival, b.server.priority, b.receipt);
  }

  void run() {
    try {
      begin(startup_.agree());
      while (true) serve(next());
    } catch (const Stopped&) {
    }
  }

  // Who joins a system that runs serves from the next whole time on.
  void begin(const Beginning& beginning) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      zero_ = beginning.zero;
      if (beginning.joins) shift_ = join();
      now_ += shift_;
      for (Message& message : waiting_) {
        if (message.early) message.timing = later(message.timing);
      }
      started_ = true;
    }
    for (const auto& action : kept_) action();
    kept_.clear();
    shift_ = 0;
  }

  int64_t join() const {
    const auto time = static_cast<int64_t>(std::ceil(std::max(elapsed() - kRounded, 0.0)));
    const std::string facts =
        "serves from " + std::to_string(time) + " on, what came before is lost";
    ROS_WARN_STREAM(reportLine("restarted", self_, "startup", facts));
    return time;
  }

  // The time of the model that the clock shows.
  double elapsed() const { return (ros::Time::now() - zero_).toSec() / time_unit_; }

  Timing later(Timing timing) const {
    timing.arrival += shift_;
    if (timing.deadline != kNever) timing.deadline += shift_;
    return timing;
  }

  // What no rebec sent, and so nobody stamped, arrives when it is received.
  void stamp(Message& message) const {
    if (message.timing.stamped) return;
    message.early = !started_;
    message.timing.arrival =
        started_ ? static_cast<int64_t>(std::floor(std::max(elapsed() + kRounded, 0.0))) : 0;
    message.timing.deadline = kNever;
  }

  Snapshot look() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto first = std::min_element(waiting_.begin(), waiting_.end(), goesBefore);
    const bool due = started_ && first != waiting_.end() && ros::Time::now() >= dueTime(*first);
    const std::string server = serving_ ? serving_name_ : due ? first->server.name : "";
    return {started_, serving_, delaying_, due, server, steps_, served_, waiting_.size(), seen_now_,
        lateness_};
  }

  void atStart(Body action) {
    if (started_) {
      action();
    } else {
      kept_.push_back(std::move(action));
    }
  }

  // The message being served and those that arrive in the future hold a place as well.
  void add(Message message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    stamp(message);
    if (waiting_.size() + (serving_ ? 1 : 0) >= capacity_) {
      report("overflow", message.server,
          "capacity " + std::to_string(capacity_) + ", " + times(message.timing));
      return;
    }
    message.receipt = ++received_;
    waiting_.push_back(std::move(message));
    changed_.notify_all();
  }

  // Blocks until the first message may be taken; a better one may come in while it waits.
  Message next() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      const auto first = std::min_element(waiting_.begin(), waiting_.end(), goesBefore);
      const ros::Time due = first == waiting_.end() ? ros::TIME_MAX : dueTime(*first);
      if (!stopping_ && ros::Time::now() >= due) return take(first);
      const uint64_t received = received_;
      wait(lock, due, [&] { return received_ != received; });
    }
  }

  Message take(std::vector<Message>::iterator position) {
    Message message = std::move(*position);
    waiting_.erase(position);
    serving_ = true;
    serving_name_ = message.server.name;
    seen_now_ = std::max(now_, message.timing.arrival);
    lateness_ = (ros::Time::now() - at(static_cast<double>(seen_now_))).toSec();
    ++steps_;
    return message;
  }

  ros::Time dueTime(const Message& message) const {
    const int64_t time = std::max(now_, message.timing.arrival);
    return std::max(at(static_cast<double>(time)), message.earliest);
  }

  void serve(Message message) {
    current_ = std::move(message);
    start_ = now_ = std::max(now_, current_.timing.arrival);
    if (now_ > current_.timing.deadline) {
      report("deadline", current_.server, times(current_.timing) + ", now " + std::to_string(now_));
    } else {
      warnIfLate();
      perform(current_.serve);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    serving_ = false;
    seen_now_ = now_;
    ++steps_;
    ++served_;
  }

  void perform(const Body& body) {
    try {
      body();
    } catch (const Violation& violation) {
      report(violation.kind(), current_.server, violation.what());
    } catch (const std::out_of_range& error) {
      report("index", current_.server, error.what());
    } catch (const std::exception& error) {
      report("exception", current_.server, error.what());
    }
    Served served{current_.server.name, current_.arguments, current_.timing.arrival, start_,
        now_};
    atStart([this, served]() mutable {
      for (int64_t* time : {&served.arrival, &served.start, &served.now}) *time += shift_;
      on_end_(served.now);
      on_served_(served);
    });
  }

  void sleepUntil(const ros::Time& due) {
    std::unique_lock<std::mutex> lock(mutex_);
    wait(lock, due, [] { return false; });
  }

  template <class Reason>
  void wait(std::unique_lock<std::mutex>& lock, const ros::Time& due, Reason woken) {
    lock.unlock();  // replacing a timer waits for its callback, which takes the lock
    setAlarm(due);
    lock.lock();
    changed_.wait(lock, [&] { return stopping_ || ros::Time::now() >= due || woken(); });
    if (stopping_) throw Stopped();
  }

  void setAlarm(const ros::Time& due) {
    const ros::Time now = ros::Time::now();
    if (due == ros::TIME_MAX || due <= now) return;
    alarm_ = node_.createTimer(due - now, &Mailbox::ring, this, true);
  }

  void ring(const ros::TimerEvent& /* event */) {
    const std::lock_guard<std::mutex> lock(mutex_);
    changed_.notify_all();
  }

  void warnIfLate() const {
    const double lateness = (ros::Time::now() - at(static_cast<double>(now_))).toSec();
    if (lateness <= slack_) return;
    const std::string facts = times(current_.timing) + ", " + std::to_string(lateness) + " s";
    ROS_WARN_STREAM_THROTTLE(1.0, reportLine("late", self_, current_.server.name, facts));
  }

  static std::string times(const Timing& timing) {
    const std::string arrival = "arrival " + std::to_string(timing.arrival);
    if (timing.deadline == kNever) return arrival;
    return arrival + ", deadline " + std::to_string(timing.deadline);
  }

  void report(const std::string& kind, const Server& server, const std::string& facts) const {
    ROS_ERROR_STREAM(reportLine(kind, self_, server.name, facts));
  }

  ros::NodeHandle node_;
  const std::string self_;
  const std::size_t capacity_;
  const int best_priority_;
  const double slack_;
  double time_unit_;
  ros::Duration settle_;
  std::mt19937 random_;

  std::function<void(const Served&)> on_served_ = [](const Served&) {};
  std::function<void(int64_t, int32_t)> on_delay_ = [](int64_t, int32_t) {};
  std::function<void(int64_t)> on_end_ = [](int64_t) {};

  // Of the body that runs: of the main thread before the start, of the serving thread after it.
  Message current_{{"constructor", kNoPriority}, {}, {}, {}, {}, {}, 0, false};
  int64_t start_ = 0;
  int64_t now_ = 0;
  ros::Time zero_;
  bool started_ = false;
  int64_t shift_ = 0;  // of all times of the constructor, while what it did is made up for
  std::vector<Body> kept_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Message> waiting_;
  uint64_t received_ = 0;
  bool serving_ = false;
  bool stopping_ = false;

  // For the watchdog.
  std::atomic<bool> delaying_{false};
  std::atomic<uint64_t> steps_{0};
  uint64_t served_ = 0;
  std::string serving_name_;
  int64_t seen_now_ = 0;
  double lateness_ = 0;

  std::thread thread_;
  ros::Timer alarm_;
  Startup startup_;
  Watchdog watchdog_;
};

}  // namespace experiment2

#endif  // EXPERIMENT2_MAILBOX_H
