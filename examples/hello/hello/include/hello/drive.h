// The drive of a robot: turns the moves of the model into velocities on the robot's cmd_vel.
#ifndef HELLO_DRIVE_H
#define HELLO_DRIVE_H

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

#include <algorithm>
#include <boost/optional.hpp>
#include <cmath>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "hello/mailbox.h"

namespace hello {

constexpr double kPeriod = 0.1;    // s, between two velocities
constexpr double kSoon = 0.001;    // s, for what is due now
constexpr double kAligned = 0.02;  // rad, close enough to drive

/// Where the robot is, as far as its own velocities tell: in metres and radians.
struct Pose {
  double x;
  double y;
  double heading;
};

class Drive {
 public:
  Drive(const ros::NodeHandle& node, Mailbox& mailbox) : node_(node), mailbox_(mailbox) {
    cell_size_ = option("cell_size", 1.0);
    move_time_ = option("move_time", mailbox.timeUnit());
    holonomic_ = option<std::string>("kind", "holonomic") == "holonomic";
    pose_.heading = option("heading", 0.0);
    cmd_vel_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 100);
    mailbox.onDelay([this](int64_t start, int32_t duration) { delayed(start, duration); });
    mailbox.onEnd([this](int64_t end) { ended(end); });
  }

  /// Moves by whole cells, in the time of the body's next delay.
  void move(int32_t dx, int32_t dy) { pending_.emplace_back(dx, dy); }

 private:
  /// A stretch of the way: where it ends, and from when to when.
  struct Leg {
    double x;
    double y;
    ros::Time start;
    ros::Time end;
    ros::Duration planned;
    ros::Time turned;
  };

  template <class T>
  T option(const std::string& name, const T& fallback) const {
    const std::string key = "drive/" + name;
    return node_.param(key, ros::NodeHandle().param(key, fallback));
  }

  void delayed(int64_t start, int32_t duration) {
    if (duration == 0) return;
    previous_ = duration * mailbox_.timeUnit();
    plan(mailbox_.at(static_cast<double>(start)), *previous_);
  }

  void ended(int64_t end) {
    plan(mailbox_.at(static_cast<double>(end)), previous_.value_or(move_time_));
    previous_ = boost::none;
  }

  void plan(ros::Time start, double duration) {
    if (pending_.empty()) return;
    const ros::Duration share(duration / static_cast<double>(pending_.size()));
    std::unique_lock<std::mutex> lock(mutex_);
    for (const auto& cells : pending_) {
      goal_x_ += cells.first * cell_size_;
      goal_y_ += cells.second * cell_size_;
      legs_.push_back({goal_x_, goal_y_, start, start + share, share, start});
      start += share;
    }
    pending_.clear();
    if (driving_) return;
    driving_ = true;
    reckoned_ = ros::Time::now();
    begin(legs_.front(), reckoned_);
    lock.unlock();  // replacing a timer waits for its callback, which takes the lock
    tickAfter(kSoon);
  }

  // A leg that starts late is sped up, though no more than twice.
  static void begin(Leg& leg, const ros::Time& now) {
    leg.start = std::max(leg.start, now);
    leg.end = std::max(leg.end, leg.start + leg.planned * 0.5);
    leg.turned = leg.start + (leg.end - leg.start) * (1.0 / 3);
  }

  void tick(const ros::TimerEvent& /* event */) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time now = ros::Time::now();
    reckon(now);
    if (now >= legs_.front().end) finishLeg(now);
    driving_ = !legs_.empty();
    twist_ = driving_ ? twistAt(now) : geometry_msgs::Twist();
    cmd_vel_.publish(twist_);
    if (driving_) tickAfter(std::min(kPeriod, (nextChange(now) - now).toSec()));
  }

  // A leg whose timers came so late that the robot is not there yet goes on for a while.
  void finishLeg(const ros::Time& now) {
    if (distance() < cell_size_ / 10) legs_.pop_front();
    if (!legs_.empty()) begin(legs_.front(), now);
  }

  void tickAfter(double seconds) {
    const ros::Duration pause(std::max(seconds, kSoon));
    timer_ = node_.createTimer(pause, &Drive::tick, this, true);
  }

  ros::Time nextChange(const ros::Time& now) const {
    const Leg& leg = legs_.front();
    if (now < leg.start) return leg.start;
    return now < leg.turned ? leg.turned : leg.end;
  }

  // Dead reckoning: where one leg ends a little off, the next one makes up for it.
  void reckon(const ros::Time& now) {
    const double elapsed = (now - reckoned_).toSec();
    const double turn = twist_.angular.z * elapsed;
    const double cosine = std::cos(pose_.heading + turn / 2);
    const double sine = std::sin(pose_.heading + turn / 2);
    pose_.x += (twist_.linear.x * cosine - twist_.linear.y * sine) * elapsed;
    pose_.y += (twist_.linear.x * sine + twist_.linear.y * cosine) * elapsed;
    pose_.heading += turn;
    reckoned_ = now;
  }

  double distance() const {
    return std::hypot(legs_.front().x - pose_.x, legs_.front().y - pose_.y);
  }

  double bearing() const {
    return std::atan2(legs_.front().y - pose_.y, legs_.front().x - pose_.x) - pose_.heading;
  }

  geometry_msgs::Twist twistAt(const ros::Time& now) const {
    if (now < legs_.front().start) return geometry_msgs::Twist();
    return holonomic_ ? slide(now) : steer(now);
  }

  geometry_msgs::Twist slide(const ros::Time& now) const {
    const Leg& leg = legs_.front();
    const double remaining = (leg.end - now).toSec();
    const double east = (leg.x - pose_.x) / remaining;
    const double north = (leg.y - pose_.y) / remaining;
    geometry_msgs::Twist twist;
    twist.linear.x = east * std::cos(pose_.heading) + north * std::sin(pose_.heading);
    twist.linear.y = north * std::cos(pose_.heading) - east * std::sin(pose_.heading);
    return twist;
  }

  // Turns first, then drives; near the goal it backs up rather than turns around.
  geometry_msgs::Twist steer(const ros::Time& now) const {
    const Leg& leg = legs_.front();
    const bool near = distance() < cell_size_ / 2;
    const double angle = std::remainder(bearing(), near ? M_PI : 2 * M_PI);
    geometry_msgs::Twist twist;
    if (std::abs(angle) > kAligned && now < leg.turned) {
      twist.angular.z = angle / (leg.turned - now).toSec();
      return twist;
    }
    const double remaining = (leg.end - now).toSec();
    twist.linear.x = distance() * std::cos(bearing()) / remaining;
    if (distance() > cell_size_ / 10) twist.angular.z = 2 * angle / remaining;
    return twist;
  }

  ros::NodeHandle node_;
  Mailbox& mailbox_;
  double cell_size_;
  double move_time_;
  bool holonomic_;
  ros::Publisher cmd_vel_;

  std::vector<std::pair<int32_t, int32_t>> pending_;
  boost::optional<double> previous_;

  std::mutex mutex_;
  std::deque<Leg> legs_;
  bool driving_ = false;
  double goal_x_ = 0;
  double goal_y_ = 0;
  Pose pose_{0, 0, 0};
  geometry_msgs::Twist twist_;
  ros::Time reckoned_;
  ros::Timer timer_;
};

}  // namespace hello

#endif  // HELLO_DRIVE_H
