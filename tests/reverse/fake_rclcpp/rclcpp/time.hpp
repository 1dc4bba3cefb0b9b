// See ../README.md.
#pragma once

#include <chrono>
#include <cmath>
#include <rclcpp/world.hpp>

enum rcl_clock_type_t { RCL_CLOCK_UNINITIALIZED, RCL_ROS_TIME, RCL_SYSTEM_TIME, RCL_STEADY_TIME };

namespace rclcpp {

class Duration {
 public:
  Duration(int32_t seconds, uint32_t nanoseconds)
      : nanoseconds_(int64_t{seconds} * 1000000000 + nanoseconds) {}
  template <class R, class P>
  Duration(const std::chrono::duration<R, P>& span)
      : nanoseconds_(std::chrono::duration_cast<std::chrono::nanoseconds>(span).count()) {}
  static Duration from_seconds(double seconds) {
    return from_nanoseconds(static_cast<int64_t>(std::llround(seconds * 1e9)));
  }
  static Duration from_nanoseconds(int64_t count) { return Duration(std::chrono::nanoseconds(count)); }
  int64_t nanoseconds() const { return nanoseconds_; }
  double seconds() const { return static_cast<double>(nanoseconds_) * 1e-9; }
  template <class D>
  D to_chrono() const {
    return std::chrono::duration_cast<D>(std::chrono::nanoseconds(nanoseconds_));
  }
  Duration operator*(double scale) const {
    return from_nanoseconds(static_cast<int64_t>(static_cast<double>(nanoseconds_) * scale));
  }
  Duration operator+(const Duration& o) const { return from_nanoseconds(nanoseconds_ + o.nanoseconds_); }
  bool operator<(const Duration& o) const { return nanoseconds_ < o.nanoseconds_; }
  bool operator>(const Duration& o) const { return nanoseconds_ > o.nanoseconds_; }
  bool operator>=(const Duration& o) const { return nanoseconds_ >= o.nanoseconds_; }

 private:
  int64_t nanoseconds_;
};

class Time {
 public:
  explicit Time(int64_t nanoseconds = 0, rcl_clock_type_t = RCL_SYSTEM_TIME) : nanoseconds_(nanoseconds) {}
  int64_t nanoseconds() const { return nanoseconds_; }
  double seconds() const { return static_cast<double>(nanoseconds_) * 1e-9; }
  Duration operator-(const Time& o) const { return Duration::from_nanoseconds(nanoseconds_ - o.nanoseconds_); }
  Time operator+(const Duration& d) const { return Time(nanoseconds_ + d.nanoseconds()); }
  bool operator<(const Time& o) const { return nanoseconds_ < o.nanoseconds_; }
  bool operator>(const Time& o) const { return nanoseconds_ > o.nanoseconds_; }
  bool operator>=(const Time& o) const { return nanoseconds_ >= o.nanoseconds_; }

 private:
  int64_t nanoseconds_;
};

class Clock {
 public:
  using SharedPtr = std::shared_ptr<Clock>;
  explicit Clock(rcl_clock_type_t = RCL_SYSTEM_TIME) {}
  Time now() const { return Time(fake::world().now); }
  bool sleep_for(const Duration& span) {
    fake::world().sleep(span.nanoseconds());
    return true;
  }
  bool sleep_until(const Time& time) { return sleep_for(time - now()); }
};

template <class R, class P>
bool sleep_for(const std::chrono::duration<R, P>& span) {
  fake::world().sleep(Duration(span).nanoseconds());
  return true;
}

class Rate {
 public:
  explicit Rate(double hertz) : Rate(std::chrono::nanoseconds(std::llround(1e9 / hertz))) {}
  template <class R, class P>
  explicit Rate(const std::chrono::duration<R, P>& period)
      : period_(Duration(period).nanoseconds()), last_(fake::world().now) {}
  bool sleep() {
    const int64_t next = last_ + period_;
    const bool in_time = next > fake::world().now;
    fake::world().sleep(next - fake::world().now);
    last_ = in_time ? next : fake::world().now;
    return in_time;
  }
  void reset() { last_ = fake::world().now; }

 private:
  int64_t period_;
  int64_t last_;
};
using WallRate = Rate;

}  // namespace rclcpp
