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

// The drive of a robot: turns the moves of the model into velocities on the robot's cmd_vel.
#ifndef EXPERIMENT1_DRIVE_H
#define EXPERIMENT1_DRIVE_H

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

#include <algorithm>
#include <atomic>
#include <boost/optional.hpp>
#include <cmath>
#include <cstdint>
#include <deque>
#include <exception>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "experiment1/mailbox.h"

namespace experiment1 {

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
    cmd_vel_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 100, true);
    mailbox.onDelay([this](int64_t start, int32_t duration) { delayed(start, duration); });
    mailbox.onEnd([this](int64_t end) { ended(end); });
    mailbox.onFailure([this] { fail(); });
    mailbox.watch([this] { check(); });
    mailbox.onStop([this] {
      stop();
      ros::WallDuration(0.1).sleep();  // roscpp drops what it has not sent yet when it ends
    });
    halt();  // a robot may still do what one that died has told it; who comes late hears it, too
    thread_ = std::thread(&Drive::run, this);
  }

  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;

  ~Drive() {
    stop();
    thread_.join();
  }

  /// Moves by whole cells, in the time of the body's next delay.
  void move(int32_t dx, int32_t dy) {
    const auto lock = waits_.lock();
    pending_.emplace_back(dx, dy);
  }

 private:
  static constexpr int64_t kLate = 500000000;  // ns, after which a tick is missed

  /// A stretch of the way: where it ends, and from when to when.
  struct Leg {
    double x;
    double y;
    ros::Time start;
    ros::Time end;
    ros::Duration planned;
    ros::Time turned;
    bool prolonged;
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
    const auto lock = waits_.lock();
    if (mailbox_.stands()) pending_.clear();
    if (pending_.empty() || waits_.isStopping()) return;
    const ros::Duration share(duration / static_cast<double>(pending_.size()));
    for (const auto& cells : pending_) {
      goal_x_ += cells.first * cell_size_;
      goal_y_ += cells.second * cell_size_;
      legs_.push_back({goal_x_, goal_y_, start, start + share, share, start, false});
      start += share;
    }
    pending_.clear();
    if (driving_) return;
    driving_ = true;
    reckoned_ = ros::Time::now();
    begin(legs_.front(), reckoned_);
    waits_.notify();
  }

  // A leg that starts late is sped up, though no more than twice.
  static void begin(Leg& leg, const ros::Time& now) {
    leg.start = std::max(leg.start, now);
    leg.end = std::max(leg.end, leg.start + leg.planned * 0.5);
    leg.turned = leg.start + (leg.end - leg.start) * (1.0 / 3);
  }

  void run() {
    try {
      auto lock = waits_.lock();
      while (true) {
        waits_.until(lock, ros::TIME_MAX, [this] { return driving_; });
        tick();
        if (driving_) waits_.until(lock, due_, [] { return false; });
      }
    } catch (const Stopped&) {
    }
  }

  void tick() {
    const ros::Time now = ros::Time::now();
    reckon(now);
    if (now >= legs_.front().end) finishLeg(now);
    driving_ = !legs_.empty();
    if (!driving_) expected_ = 0;
    send(driving_ ? twistAt(now) : geometry_msgs::Twist());
    if (!driving_) return;
    const double pause = std::max(std::min(kPeriod, (nextChange(now) - now).toSec()), kSoon);
    due_ = now + ros::Duration(pause);
    expected_ = static_cast<int64_t>(due_.toNSec());
  }

  // Called by another thread, which does not wait for this one: a robot must not drive on unguided.
  void check() {
    const int64_t due = expected_;
    if (due == 0 || static_cast<int64_t>(ros::Time::now().toNSec()) < due + kLate) return;
    cmd_vel_.publish(geometry_msgs::Twist());
    if (missed_ == due) return;
    missed_ = due;
    complain("no velocity in time");
  }

  // A velocity that does not go out must not be followed by others, and the robot has to stand.
  void send(const geometry_msgs::Twist& twist) {
    try {
      cmd_vel_.publish(twist);
      twist_ = twist;
    } catch (const std::exception& error) {
      complain(error.what());
      forget();
      stand();
    }
  }

  void stand() {
    try {
      cmd_vel_.publish(geometry_msgs::Twist());
    } catch (const std::exception& error) {
      complain(error.what());
    }
  }

  // A leg whose ticks came so late that the robot is not there yet goes on for half its plan.
  void finishLeg(const ros::Time& now) {
    Leg& leg = legs_.front();
    if (distance() < cell_size_ / 10) {
      legs_.pop_front();
    } else if (leg.prolonged) {
      complain("overrun, " + std::to_string(distance()) + " m from the goal");
      return forget();
    } else {
      leg.prolonged = true;
    }
    if (!legs_.empty()) begin(legs_.front(), now);
  }

  // What is planned is dropped; where the robot should be stays, and the next move goes there.
  void forget() {
    if (driving_) reckon(ros::Time::now());
    legs_.clear();
    driving_ = false;
    expected_ = 0;
    twist_ = geometry_msgs::Twist();
  }

  void halt() {
    forget();
    send(twist_);
  }

  void fail() {
    const auto lock = waits_.lock();
    pending_.clear();
    if (!waits_.isStopping()) halt();
  }

  // While ROS still sends: the last velocity is zero.
  void stop() {
    const auto lock = waits_.lock();
    if (waits_.isStopping()) return;
    waits_.stop();
    halt();
  }

  void complain(const std::string& facts) const {
    ROS_ERROR_STREAM(reportLine("drive", mailbox_.self(), "cmd_vel", facts));
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

  boost::optional<double> previous_;

  // Of all threads, which hold its lock.
  detail::Waiting waits_;
  std::vector<std::pair<int32_t, int32_t>> pending_;
  std::deque<Leg> legs_;
  bool driving_ = false;
  double goal_x_ = 0;
  double goal_y_ = 0;
  Pose pose_{0, 0, 0};
  geometry_msgs::Twist twist_;
  ros::Time reckoned_;
  ros::Time due_;                     // the next tick
  std::atomic<int64_t> expected_{0};  // the same in nanoseconds; 0 while nothing is driven
  int64_t missed_ = 0;                // that which was complained about
  std::thread thread_;
};

}  // namespace experiment1

#endif  // EXPERIMENT1_DRIVE_H
