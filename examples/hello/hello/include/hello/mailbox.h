// Copyright 2026 The rebsync authors
//
// Licensed under the Apache License, Version 2.0 (the "License");
// you may not use this file except in compliance with the License.
// You may obtain a copy of the License at
//
//     http://www.apache.org/licenses/LICENSE-2.0
//
// Unless required by applicable law or agreed to in writing, software
// distributed under the License is distributed on an "AS IS" BASIS,
// WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
// See the License for the specific language governing permissions and
// limitations under the License.

// The mailbox of a rebec: serves its messages one by one, in the model's order and time.
#ifndef HELLO_MAILBOX_H
#define HELLO_MAILBOX_H

#include <ros/ros.h>
#include <semaphore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/optional.hpp>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "hello/startup.h"
#include "hello/values.h"
#include "hello/watchdog.h"

namespace hello {

constexpr uint32_t kQueueSize = 1000;
constexpr double kRounded = 1e-6;  // units of model time, more than what division loses
constexpr double kFarAway = 1e9;   // s, still a valid ros::Duration

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

namespace detail {

constexpr bool kTimed = true;  // whether time passes in the model

/// Waits for moments of the ROS clock, be it simulated or not, and for what happens before, without
/// a timer of ROS: who replaces one waits for its callback.
class Waiting {
 public:
  using Lock = std::unique_lock<std::mutex>;

  Lock lock() { return Lock(mutex_); }

  /// Blocks with the lock let go; TIME_MAX is never. Throws Stopped when the node shuts down.
  template <class Woken>
  void until(Lock& lock, const ros::Time& due, Woken woken) {
    while (!stopping_ && ros::Time::now() < due && !woken()) {
      if (due == ros::TIME_MAX) {
        changed_.wait(lock);
      } else {
        changed_.wait_for(lock, pause(due));
      }
    }
    if (stopping_) throw Stopped();
  }

  /// Has those look again that wait; call it with the lock.
  void notify() { changed_.notify_all(); }

  /// Call it with the lock.
  void stop() {
    stopping_ = true;
    notify();
  }
  bool isStopping() const { return stopping_; }

 private:
  // Nobody tells when a simulated clock has moved: it is looked at as often as by ros::Duration.
  static std::chrono::nanoseconds pause(const ros::Time& due) {
    if (ros::Time::isSimTime()) return std::chrono::milliseconds(1);
    const std::chrono::nanoseconds rest((due - ros::Time::now()).toNSec());
    return std::min<std::chrono::nanoseconds>(rest, std::chrono::seconds(1));
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
};

/// Whether a program may write a line again: once a minute.
class Rarely {
 public:
  bool again() {
    const auto now = std::chrono::steady_clock::now();
    if (last_ && now - *last_ < std::chrono::minutes(1)) return false;
    last_ = now;
    return true;
  }

 private:
  boost::optional<std::chrono::steady_clock::time_point> last_;
};

/// Runs an action in a thread of its own at the first SIGINT or SIGTERM, while ROS still sends.
class Interrupts {
 public:
  ~Interrupts() {
    if (!thread_.joinable()) return;
    ending_ = true;
    sem_post(raised());
    thread_.join();
  }

  void start(std::function<void()> act) {
    thread_ = std::thread([this, act] {
      while (sem_wait(raised()) != 0) continue;  // it has been interrupted
      if (!ending_) act();
    });
    for (const int number : {SIGINT, SIGTERM}) std::signal(number, [](int) { sem_post(raised()); });
  }

 private:
  static sem_t* raised() {
    static sem_t semaphore = {};
    return &semaphore;
  }

  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// Whether any code of the program calls Mailbox::delay, be it ever run or not.
inline bool& delays() {
  static bool found = false;
  return found;
}

template <class Time>
struct Delaying {
  static const bool found;
};

template <class Time>
const bool Delaying<Time>::found = delays() = true;

}  // namespace detail

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
    publish_state_ = options.param("publish_state", true);
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
  void publish(const ros::Publisher& publisher, M& message, const When& when) {
    message.timing = when.from(now_);
    if (started_) return publisher.publish(message);
    kept_.push_back([this, publisher, message]() mutable {
      message.timing = later(message.timing);
      publisher.publish(message);
    });
  }

  /// Sends to the rebec itself.
  void post(const Server& server, const When& when, std::string arguments, Body serve) {
    const bool early = !started_;
    add({server, when.from(now_), self_, std::move(arguments), std::move(serve), {}, {}, 0,
        early});
  }

  /// Takes in what another rebec sent.
  void receive(const Server& server, const Timing& timing, std::string sender,
      std::string arguments, Body serve) {
    // What is sent in one go may come in any order: give a more urgent message time to come too.
    const bool overtakable = server.priority > best_priority_;
    const ros::Time earliest = overtakable ? ros::Time::now() + settle_ : ros::Time();
    add({server, timing, std::move(sender), std::move(arguments), std::move(serve), earliest, {},
        0, false});
  }

  int32_t now() const { return static_cast<int32_t>(now_); }
  int32_t arrival() const { return static_cast<int32_t>(current_->timing.arrival); }
  int32_t expiry() const {
    return static_cast<int32_t>(std::min<int64_t>(current_->timing.deadline, INT32_MAX));
  }
  int32_t waitingTime() const { return static_cast<int32_t>(start_ - current_->timing.arrival); }
  const std::string& sender() const { return current_->sender; }
  const std::string& self() const { return self_; }

  /// Keeps the rebec busy; ends early, by an exception, only when the node shuts down.
  template <class Time>
  void delay(Time time) {
    static_cast<void>(detail::Delaying<Time>::found);
    if (time < 0) throw Violation("time", "delay " + std::to_string(time));
    const int64_t start = now_;
    const auto duration = static_cast<int32_t>(time);
    now_ += duration;
    atStart([this, start, duration] { on_delay_(start + shift_, duration); });
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
    report("choice", current_->server, text(*seen) + " is outside the choices");
    return choose(choices);
  }

  void assertion(bool holds, const std::string& claim = "does not hold") const {
    if (!holds) report("assertion", current_->server, claim);
  }

  void onServed(std::function<void(const Served&)> observer) { on_served_ = std::move(observer); }
  void onDelay(std::function<void(int64_t, int32_t)> observer) { on_delay_ = std::move(observer); }
  void onEnd(std::function<void(int64_t)> observer) { on_end_ = std::move(observer); }
  /// Called when the node is told to end, while ROS still sends.
  void onStop(Body observer) { on_stop_ = std::move(observer); }
  /// Called, by any thread, when something is reported that the model excludes.
  void onFailure(Body observer) { on_failure_ = std::move(observer); }

  /// The moment on the ROS clock that a logical time stands for.
  ros::Time at(double time) const {
    return zero_ + ros::Duration(std::min(time * time_unit_, kFarAway));
  }
  double timeUnit() const { return time_unit_; }

  /// Whether a robot must not move: what the rebec did again and again has ended.
  bool stands() const { return stands_; }

  /// Has a thread of its own look at something a few times a second; call it before start().
  void watch(Body check) { watchdog_.addCheck(std::move(check)); }

  /// Runs the constructor of the model; call it before start().
  void construct(const Body& body) { perform(body); }

  void start() {
    interrupts_.start([this] {
      on_stop_();
      ros::requestShutdown();
    });
    thread_ = std::thread(&Mailbox::run, this);
    watchdog_.start();
  }

  /// Ends serving; no body runs any more when this returns.
  void stop() {
    watchdog_.stop();
    startup_.stop();
    {
      auto lock = waits_.lock();
      waits_.stop();
    }
    if (thread_.joinable()) thread_.join();
    auto lock = waits_.lock();
    served_.wait(lock, [this] { return !busy_; });
  }

 private:
  struct Message {
    Server server;
    Timing timing;
    std::string sender;
    std::string arguments;
    Body serve;
    ros::Time earliest;
    ros::Time received;  // if no rebec sent it: its arrival is rounded down
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
    ending([this] {
      begin(startup_.agree());
      auto lock = waits_.lock();
      while (true) {
        drain(lock);
        alarm_ = busy_ ? ros::TIME_MAX : nextDue();  // who serves rouses this one in the end
        roused_ = false;
        waits_.until(lock, alarm_, [this] { return roused_; });
      }
    });
  }

  // What a thread does until the node shuts down.
  template <class Action>
  static void ending(Action action) {
    try {
      action();
    } catch (const Stopped&) {
    }
  }

  // Who joins a system that runs serves from the next whole time on.
  void begin(const Beginning& beginning) {
    auto lock = waits_.lock();
    zero_ = beginning.zero;
    if (beginning.joins) shift_ = join();
    now_ += shift_;
    for (Message& message : waiting_) {
      if (message.early) message.timing = later(message.timing);
    }
    started_ = busy_ = true;
    lock.unlock();
    for (const auto& action : kept_) action();
    kept_.clear();
    lock.lock();
    shift_ = 0;
    busy_ = false;
  }

  // Nothing is sent before time 0, so nothing is lost then.
  int64_t join() const {
    const int64_t time = wholeTime();
    const std::string facts = "serves from " + std::to_string(time) + " on" +
                              (time > 0 ? ", what came before is lost" : "");
    ROS_WARN_STREAM(reportLine("restarted", self_, "startup", facts));
    return time;
  }

  // The next one of the model.
  int64_t wholeTime() const {
    return static_cast<int64_t>(std::ceil(std::max(elapsed() - kRounded, 0.0)));
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
    message.received = ros::Time::now();
  }

  Snapshot look() {
    const auto lock = waits_.lock();
    const bool due = started_ && !busy_ && !waiting_.empty() && ros::Time::now() >= dueTime(*first());
    const std::string server = due ? first()->server.name : serving_name_;
    return {started_, serving_, delaying_, due, server, steps_, served_count_, waiting_.size(),
        seen_now_, lateness_, listed(overflowed_), listed(ended_)};
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
    auto lock = waits_.lock();
    stamp(message);
    if (waiting_.size() + (serving_ ? 1 : 0) >= capacity_) {
      std::string facts = "capacity " + std::to_string(capacity_) + ", " + times(message.timing);
      if (message.timing.stamped) facts += lose(message);
      report("overflow", message.server, facts);
      return;
    }
    message.receipt = ++received_;
    waiting_.push_back(std::move(message));
    if (!started_ || busy_) return;  // who serves or begins finds it
    if (!detail::delays()) ending([this, &lock] { drain(lock); });
    rouse();
  }

  // What a rebec sends to itself again and again ends with the first such message that is lost.
  std::string lose(const Message& message) {
    overflowed_.insert(message.server.name);
    if (message.sender != self_) return "";
    ended_.insert(message.server.name);
    stands_ = true;
    return ", sent to itself, which ends here";
  }

  static std::string listed(const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
    return text;
  }

  // Has the serving thread look again if something is due before it would.
  void rouse() {
    if (busy_ || alarm_ <= nextDue()) return;
    roused_ = true;
    waits_.notify();
  }

  // Serves what is due in the model's order, unless another thread does: it finds the rest.
  void drain(detail::Waiting::Lock& lock) {
    if (busy_ || waits_.isStopping()) return;
    busy_ = true;
    try {
      while (!waits_.isStopping() && ros::Time::now() >= nextDue()) {
        const Message message = take(first());
        lock.unlock();
        serve(message);
        lock.lock();
        serving_ = false;
        seen_now_ = now_;
        ++steps_;
        ++served_count_;
      }
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      release();
      throw;
    }
    release();
  }

  void release() {
    busy_ = serving_ = false;
    serving_name_.clear();
    if (waits_.isStopping()) served_.notify_all();
  }

  std::vector<Message>::iterator first() {
    return std::min_element(waiting_.begin(), waiting_.end(), goesBefore);
  }

  ros::Time nextDue() { return waiting_.empty() ? ros::TIME_MAX : dueTime(*first()); }

  Message take(std::vector<Message>::iterator position) {
    Message message = std::move(*position);
    waiting_.erase(position);
    serving_ = true;
    serving_name_ = message.server.name;
    seen_now_ = std::max(now_, message.timing.arrival);
    const ros::Time due = std::max(at(static_cast<double>(seen_now_)), message.received);
    lateness_ = (ros::Time::now() - due).toSec();
    ++steps_;
    return message;
  }

  ros::Time dueTime(const Message& message) const {
    const int64_t time = std::max(now_, message.timing.arrival);
    return std::max(at(static_cast<double>(time)), message.earliest);
  }

  void serve(const Message& message) {
    current_ = &message;
    start_ = now_ = std::max(now_, message.timing.arrival);
    if (now_ > message.timing.deadline) {
      report("deadline", message.server, times(message.timing) + ", now " + std::to_string(now_));
    } else {
      warnIfLate();
      perform(message.serve);
    }
  }

  void perform(const Body& body) {
    try {
      body();
    } catch (const Violation& violation) {
      report(violation.kind(), current_->server, violation.what());
    } catch (const std::out_of_range& error) {
      report("index", current_->server, error.what());
    } catch (const std::exception& error) {
      report("exception", current_->server, error.what());
    }
    Served served{current_->server.name, current_->arguments, current_->timing.arrival, start_,
        now_};
    if (started_) return finish(served);
    kept_.push_back([this, served]() mutable {
      for (int64_t* time : {&served.arrival, &served.start, &served.now}) *time += shift_;
      finish(served);
    });
  }

  void finish(const Served& served) const {
    on_end_(served.now);
    if (publish_state_) on_served_(served);
  }

  void sleepUntil(const ros::Time& due) {
    auto lock = waits_.lock();
    waits_.until(lock, due, [] { return false; });
  }

  // Where no time passes in the model, nothing is late.
  void warnIfLate() {
    if (!detail::kTimed) return;
    if (lateness_ <= slack_ || !late_.again()) return;
    const std::string facts = times(current_->timing) + ", " + std::to_string(lateness_) + " s";
    ROS_WARN_STREAM(reportLine("late", self_, current_->server.name, facts));
  }

  static std::string times(const Timing& timing) {
    const std::string arrival = "arrival " + std::to_string(timing.arrival);
    if (timing.deadline == kNever) return arrival;
    return arrival + ", deadline " + std::to_string(timing.deadline);
  }

  void report(const std::string& kind, const Server& server, const std::string& facts) const {
    ROS_ERROR_STREAM(reportLine(kind, self_, server.name, facts));
    on_failure_();
  }

  ros::NodeHandle node_;
  const std::string self_;
  const std::size_t capacity_;
  const int best_priority_;
  const double slack_;
  double time_unit_;
  ros::Duration settle_;
  bool publish_state_;
  std::mt19937 random_;

  std::function<void(const Served&)> on_served_ = [](const Served&) {};
  std::function<void(int64_t, int32_t)> on_delay_ = [](int64_t, int32_t) {};
  std::function<void(int64_t)> on_end_ = [](int64_t) {};
  Body on_failure_ = [] {};
  Body on_stop_ = [] {};

  // Of the body that runs: of the main thread before the start, of who serves after it.
  const Message constructor_{{"constructor", kNoPriority}, {}, {}, {}, {}, {}, {}, 0, false};
  const Message* current_ = &constructor_;
  int64_t start_ = 0;
  int64_t now_ = 0;
  detail::Rarely late_;
  ros::Time zero_;
  int64_t shift_ = 0;  // of all times of the constructor, while what it did is made up for
  std::vector<Body> kept_;

  // Of all threads, which hold its lock.
  detail::Waiting waits_;
  std::atomic<bool> started_{false};  // also asked by bodies, which hold none
  std::vector<Message> waiting_;
  uint64_t received_ = 0;
  bool busy_ = false;     // somebody serves one message after the other
  bool serving_ = false;  // a message is being served
  std::condition_variable served_;
  ros::Time alarm_;  // when the serving thread looks again
  bool roused_ = false;

  // For the watchdog.
  std::atomic<bool> delaying_{false};
  std::atomic<uint64_t> steps_{0};
  uint64_t served_count_ = 0;
  std::string serving_name_;
  int64_t seen_now_ = 0;
  double lateness_ = 0;
  std::set<std::string> overflowed_;  // servers of which what a rebec sent was dropped
  std::set<std::string> ended_;       // those among them that the rebec sent to itself
  std::atomic<bool> stands_{false};

  std::thread thread_;
  Startup startup_;
  Watchdog watchdog_;
  detail::Interrupts interrupts_;
};

}  // namespace hello

#endif  // HELLO_MAILBOX_H
