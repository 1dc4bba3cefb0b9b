// See README.md.
#ifndef FAKE_ROS_ROS_H
#define FAKE_ROS_ROS_H

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace boost {
using std::bind;
using std::function;
using std::make_shared;
using std::shared_ptr;
}  // namespace boost
using namespace std::placeholders;

namespace fake {

/// What callbacks have done, one line each: the seconds that had passed, then what.
inline std::vector<std::string>& effects() {
  static std::vector<std::string> all;
  return all;
}

inline double& clock() {
  static double seconds = 0;
  return seconds;
}

/// The callbacks of subscriptions by their topics, for a driver to call.
template <class M>
using Callback = std::function<void(const std::shared_ptr<const M>&)>;

template <class M>
std::map<std::string, Callback<M>>& callbacks() {
  static std::map<std::string, Callback<M>> all;
  return all;
}

/// What happens while a node serves, and until when; a driver may say it. Nothing happens otherwise.
struct World {
  struct Timer {
    double due;
    double period;
    bool one_shot;
    std::function<void()> callback;
  };
  std::function<void()> spin = [] {};
  std::function<void()> spin_once = [] {};
  std::function<bool()> ok = [] { return true; };
  std::vector<Timer> timers;
};

inline World& world() {
  static World one;
  return one;
}

inline std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

inline void note(const std::string& what) { effects().push_back(number(clock()) + " " + what); }

}  // namespace fake

namespace ros {

struct Duration {
  explicit Duration(double seconds = 0) : seconds_(seconds) {}
  Duration(int32_t seconds, int32_t nanoseconds) : seconds_(seconds + nanoseconds * 1e-9) {}
  double toSec() const { return seconds_; }
  bool sleep() const {
    fake::clock() += seconds_;
    return true;
  }
  bool operator<(const Duration& other) const { return seconds_ < other.seconds_; }
  bool operator>(const Duration& other) const { return seconds_ > other.seconds_; }
  double seconds_;
};
using WallDuration = Duration;

struct Time {
  explicit Time(double seconds = 0) : seconds_(seconds) {}
  static Time now() { return Time(fake::clock()); }
  double toSec() const { return seconds_; }
  Duration operator-(const Time& other) const { return Duration(seconds_ - other.seconds_); }
  bool operator<(const Time& other) const { return seconds_ < other.seconds_; }
  bool operator>(const Time& other) const { return seconds_ > other.seconds_; }
  double seconds_;
};
using WallTime = Time;

struct Rate {
  explicit Rate(double hz) : hz_(hz) {}
  bool sleep() const {
    fake::clock() += 1.0 / hz_;
    return true;
  }
  double hz_;
};

struct TimerEvent {
  Time current_real;
};

struct Timer {
  void start() {}
  void stop() {}
};
using WallTimer = Timer;

struct Subscriber {
  void shutdown() {}
};

struct Publisher {
  std::string topic;

  template <class M>
  void publish(const M& message) const {
    fake::note("publish " + topic + shown(message));
  }
  template <class M>
  void publish(const std::shared_ptr<M>& message) const {
    publish(*message);
  }
  uint32_t getNumSubscribers() const { return 1; }
};

class NodeHandle {
 public:
  explicit NodeHandle(const std::string& = "") {}

  template <class M>
  Publisher advertise(const std::string& topic, uint32_t, bool = false) {
    return Publisher{topic};
  }

  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t,
      void (T::*callback)(const std::shared_ptr<const M>&), T* object) {
    return take<M>(topic, [=](const std::shared_ptr<const M>& m) { (object->*callback)(m); });
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t, void (T::*callback)(const M&),
      T* object) {
    return take<M>(topic, [=](const std::shared_ptr<const M>& m) { (object->*callback)(*m); });
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, uint32_t,
      void (*callback)(const std::shared_ptr<const M>&)) {
    return take<M>(topic, callback);
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, uint32_t, void (*callback)(const M&)) {
    return take<M>(topic, [=](const std::shared_ptr<const M>& m) { callback(*m); });
  }
  template <class M, class F>
  Subscriber subscribe(const std::string& topic, uint32_t, const F& callback) {
    if constexpr (std::is_invocable_v<F, const std::shared_ptr<const M>&>) {
      return take<M>(topic, callback);
    } else {
      return take<M>(topic, [=](const std::shared_ptr<const M>& m) mutable { callback(*m); });
    }
  }

  template <class T>
  Timer createTimer(const Duration& period, void (T::*callback)(const TimerEvent&), T* object,
      bool one_shot = false) {
    return timer(period, one_shot, [=] { (object->*callback)(TimerEvent()); });
  }
  Timer createTimer(const Duration& period, const std::function<void(const TimerEvent&)>& callback,
      bool one_shot = false) {
    return timer(period, one_shot, [=] { callback(TimerEvent()); });
  }

  template <class T>
  bool param(const std::string&, T& value, const T& otherwise) const {
    value = otherwise;
    return false;
  }
  template <class T>
  bool getParam(const std::string&, T&) const {
    return false;
  }

 private:
  template <class M>
  static Subscriber take(const std::string& topic, const fake::Callback<M>& callback) {
    fake::callbacks<M>()[topic] = callback;
    return {};
  }
  static Timer timer(const Duration& period, bool one_shot, std::function<void()> callback) {
    if (one_shot) fake::note("arm " + fake::number(period.toSec()));
    const double due = fake::clock() + period.toSec();
    fake::world().timers.push_back({due, period.toSec(), one_shot, std::move(callback)});
    return {};
  }
};

inline void init(int&, char**, const std::string&) {}
inline bool ok() { return fake::world().ok(); }
inline void spin() { fake::world().spin(); }
inline void spinOnce() { fake::world().spin_once(); }
inline void shutdown() {}

}  // namespace ros

#define ROS_DEBUG(...) ((void)0)
#define ROS_INFO(...) ((void)0)
#define ROS_WARN(...) ((void)0)
#define ROS_ERROR(...) ((void)0)
#define ROS_INFO_STREAM(args) ((void)0)
#define ROS_WARN_STREAM(args) ((void)0)
#define ROS_WARN_THROTTLE(period, ...) ((void)0)

/// A message type: `FAKE_MESSAGE(package, Name, fields, what `shown` appends)`.
#define FAKE_MESSAGE(package, Name, fields, values)                       \
  namespace package {                                                     \
  struct Name {                                                           \
    using Ptr = std::shared_ptr<Name>;                                    \
    using ConstPtr = std::shared_ptr<const Name>;                         \
    fields                                                                \
  };                                                                      \
  using Name##Ptr = Name::Ptr;                                            \
  using Name##ConstPtr = Name::ConstPtr;                                  \
  inline std::string shown(const Name& m) {                               \
    (void)m;                                                              \
    return values;                                                        \
  }                                                                       \
  }

namespace fake {

template <class T>
std::string value(T number_) {
  if constexpr (std::is_integral<T>::value) {
    return " i" + std::to_string(number_);  // all digits: it need not be a double
  } else {
    return " " + number(static_cast<double>(number_));
  }
}

}  // namespace fake

#endif  // FAKE_ROS_ROS_H
