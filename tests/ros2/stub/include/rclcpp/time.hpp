// Time as rclcpp tells it; comparing the times of different clocks throws, as there.
#pragma once

#include <builtin_interfaces/msg/time.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

enum rcl_clock_type_t { RCL_CLOCK_UNINITIALIZED, RCL_ROS_TIME, RCL_SYSTEM_TIME, RCL_STEADY_TIME };

struct rcl_duration_t {
  int64_t nanoseconds = 0;
};

struct rcl_jump_threshold_t {
  bool on_clock_change = false;
  rcl_duration_t min_forward;
  rcl_duration_t min_backward;
};

struct rcl_time_jump_t {};

namespace rclcpp {

class Duration {
 public:
  Duration(int32_t seconds, uint32_t nanoseconds)
      : nanoseconds_(int64_t{seconds} * 1000000000 + nanoseconds) {}

  static Duration from_seconds(double seconds) {
    return from_nanoseconds(static_cast<int64_t>(std::llround(seconds * 1e9)));
  }
  static Duration from_nanoseconds(int64_t nanoseconds) {
    Duration duration(0, 0);
    duration.nanoseconds_ = nanoseconds;
    return duration;
  }

  int64_t nanoseconds() const { return nanoseconds_; }
  double seconds() const { return static_cast<double>(nanoseconds_) * 1e-9; }

  Duration operator*(double scale) const {
    return from_nanoseconds(static_cast<int64_t>(static_cast<double>(nanoseconds_) * scale));
  }
  bool operator<(const Duration& other) const { return nanoseconds_ < other.nanoseconds_; }

 private:
  int64_t nanoseconds_;
};

class Time {
 public:
  Time(int32_t seconds, uint32_t nanoseconds, rcl_clock_type_t clock = RCL_SYSTEM_TIME)
      : nanoseconds_(int64_t{seconds} * 1000000000 + nanoseconds), clock_(clock) {
    if (seconds < 0) throw std::runtime_error("a time before 0");
  }
  explicit Time(int64_t nanoseconds = 0, rcl_clock_type_t clock = RCL_SYSTEM_TIME)
      : nanoseconds_(nanoseconds), clock_(clock) {}
  Time(const builtin_interfaces::msg::Time& time, rcl_clock_type_t clock = RCL_ROS_TIME)
      : Time(time.sec, time.nanosec, clock) {}

  operator builtin_interfaces::msg::Time() const {
    builtin_interfaces::msg::Time time;
    time.sec = static_cast<int32_t>(nanoseconds_ / 1000000000);
    time.nanosec = static_cast<uint32_t>(nanoseconds_ % 1000000000);
    return time;
  }

  int64_t nanoseconds() const { return nanoseconds_; }
  double seconds() const { return static_cast<double>(nanoseconds_) * 1e-9; }
  rcl_clock_type_t get_clock_type() const { return clock_; }

  Duration operator-(const Time& other) const {
    return Duration::from_nanoseconds(nanoseconds_ - same(other).nanoseconds_);
  }
  Time operator+(const Duration& duration) const {
    return Time(nanoseconds_ + duration.nanoseconds(), clock_);
  }
  Time operator-(const Duration& duration) const {
    return Time(nanoseconds_ - duration.nanoseconds(), clock_);
  }
  bool operator==(const Time& other) const { return nanoseconds_ == same(other).nanoseconds_; }
  bool operator!=(const Time& other) const { return !(*this == other); }
  bool operator<(const Time& other) const { return nanoseconds_ < same(other).nanoseconds_; }
  bool operator<=(const Time& other) const { return nanoseconds_ <= same(other).nanoseconds_; }
  bool operator>(const Time& other) const { return nanoseconds_ > same(other).nanoseconds_; }
  bool operator>=(const Time& other) const { return nanoseconds_ >= same(other).nanoseconds_; }

 private:
  const Time& same(const Time& other) const {
    if (clock_ != other.clock_) throw std::runtime_error("times of different clocks");
    return other;
  }

  int64_t nanoseconds_;
  rcl_clock_type_t clock_;
};

}  // namespace rclcpp
