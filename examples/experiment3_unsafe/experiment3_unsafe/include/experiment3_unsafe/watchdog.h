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

// Watches over a rebec from a thread of its own: heartbeats, stalls, diagnostics.
#ifndef EXPERIMENT3_UNSAFE_WATCHDOG_H
#define EXPERIMENT3_UNSAFE_WATCHDOG_H

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "experiment3_unsafe/startup.h"

namespace experiment3_unsafe {

constexpr int kPause = 250;    // ms between looks
constexpr int kPatience = 20;  // looks at the same

/// What a mailbox does at a moment.
struct Snapshot {
  bool started;
  bool serving;        // a body runs
  bool delaying;       // it waits in a `delay`
  bool due;            // a message may be taken
  std::string server;  // of the body, or of the message
  uint64_t steps;      // changes with all that bodies do
  uint64_t served;
  std::size_t waiting;
  int64_t now;
  double lateness;         // of what was taken last, in seconds
  std::string overflowed;  // servers of which what a rebec sent was dropped
  std::string ended;       // those that the rebec sent to itself: nothing of them is due any more
};

/// Announces the rebec while it lives, and reports what should happen and does not.
class Watchdog {
 public:
  Watchdog(Startup& startup, double slack, std::function<Snapshot()> look)
      : startup_(startup), slack_(slack), look_(std::move(look)) {
    ros::NodeHandle node;
    heartbeat_ = std::chrono::duration<double>(node.param("mailbox/heartbeat", 1.0));
    diagnostics_ = node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
  }

  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  ~Watchdog() { stop(); }

  /// What else is to be looked at a few times a second; call it before start().
  void addCheck(std::function<void()> check) { checks_.push_back(std::move(check)); }

  void start() { thread_ = std::thread(&Watchdog::run, this); }

  void stop() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
  }

 private:
  using Status = diagnostic_msgs::DiagnosticStatus;
  using Steady = std::chrono::steady_clock;

  void run() {
    auto beaten = Steady::now() - heartbeat_;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!stopping_) {
      lock.unlock();
      const Snapshot seen = look_();
      checkProgress(seen);
      for (const auto& check : checks_) check();
      if (Steady::now() - beaten >= heartbeat_) {
        beaten = Steady::now();
        startup_.beat();
        publish(seen);
      }
      lock.lock();
      changed_.wait_for(lock, std::chrono::milliseconds(kPause), [this] { return stopping_; });
    }
  }

  // Looks are counted, not seconds: a process that stood still as a whole has not stalled.
  void checkProgress(const Snapshot& seen) {
    const bool busy = seen.serving ? !seen.delaying : seen.due;
    looks_ = busy && seen.steps == steps_ ? looks_ + 1 : 0;
    steps_ = seen.steps;
    if (looks_ != kPatience) return;
    const std::string what = seen.serving ? "runs" : "due";
    const std::string facts = what + " for " + std::to_string(kPatience * kPause / 1000) + " s";
    ROS_ERROR_STREAM(reportLine("stall", startup_.self(), seen.server, facts));
  }

  void publish(const Snapshot& seen) const {
    std::string lost;
    for (const std::string& name : startup_.lost()) lost += (lost.empty() ? "" : " ") + name;
    const double offset = startup_.clockOffset();
    Status status;
    status.name = ros::this_node::getName().substr(1) + ": mailbox";
    status.hardware_id = startup_.self();
    status.level = Status::OK;
    status.message = "serves";
    const auto tell = [&status](bool holds, uint8_t level, const std::string& message) {
      if (!holds) return;
      status.level = level;
      status.message = message;
    };
    tell(!seen.started, Status::WARN, "waits for the start");
    tell(seen.lateness > slack_, Status::WARN, "late");
    tell(offset > std::max(slack_, heartbeat_.count()), Status::WARN, "clocks differ");
    tell(!seen.overflowed.empty(), Status::ERROR, "overflow of " + seen.overflowed);
    tell(!lost.empty(), Status::ERROR, "lost " + lost);
    tell(!seen.ended.empty(), Status::ERROR, "ended " + seen.ended);
    tell(looks_ >= kPatience, Status::ERROR, "stall in " + seen.server);
    add(status, "model time", std::to_string(seen.now));
    add(status, "waiting", std::to_string(seen.waiting));
    add(status, "served", std::to_string(seen.served));
    add(status, "lateness", std::to_string(seen.lateness));
    add(status, "ended", seen.ended);
    add(status, "lost rebecs", lost);
    add(status, "clock offset", std::to_string(offset));
    diagnostic_msgs::DiagnosticArray diagnostics;
    diagnostics.header.stamp = ros::Time::now();
    diagnostics.status.push_back(status);
    diagnostics_.publish(diagnostics);
  }

  static void add(Status& status, const std::string& key, const std::string& value) {
    diagnostic_msgs::KeyValue pair;
    pair.key = key;
    pair.value = value;
    status.values.push_back(pair);
  }

  Startup& startup_;
  const double slack_;
  const std::function<Snapshot()> look_;
  std::vector<std::function<void()>> checks_;
  std::chrono::duration<double> heartbeat_{};
  ros::Publisher diagnostics_;
  uint64_t steps_ = 0;
  int looks_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace experiment3_unsafe

#endif  // EXPERIMENT3_UNSAFE_WATCHDOG_H
