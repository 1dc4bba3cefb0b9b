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

// The common start of all rebecs: once everyone listens to everyone, time 0 is agreed on.
#ifndef RUNNING_EXAMPLE_STARTUP_H
#define RUNNING_EXAMPLE_STARTUP_H

#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "running_example/Announcement.h"

namespace running_example {

constexpr int kSilence = 3;  // heartbeats

/// Thrown through a body when the node shuts down, so that nothing is sent too early.
struct Stopped {};

/// One line for the log, the same for everything that is reported.
inline std::string reportLine(const std::string& kind, const std::string& rebec,
    const std::string& server, const std::string& facts) {
  return kind + ": " + rebec + "." + server + " (" + facts + ")";
}

/// The common time 0, and whether the others had begun before this rebec came.
struct Beginning {
  ros::Time zero;
  bool joins;
};

/// Announces this rebec, again and again, waits for all the others, and tells which are silent.
class Startup {
 public:
  explicit Startup(std::string self) : self_(std::move(self)) {
    ros::NodeHandle node;
    node.getParam("mailbox/rebecs", rebecs_);
    if (rebecs_.empty()) rebecs_.push_back(self_);
    timeout_ = std::chrono::duration<double>(node.param("mailbox/startup_timeout", 30.0));
    announcement_ = node.advertise<Announcement>("startup", 1, true);
    announcements_ = node.subscribe("startup", 1000, &Startup::receive, this,
        ros::TransportHints().tcpNoDelay());
  }

  /// The node announces itself only after a rebec has subscribed to this topic.
  void expectSubscriber(const std::string& topic) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (rebecs_.size() > 1) unmatched_.insert(topic);
  }

  /// Other tools may subscribe as well; only the rebecs that take part count.
  void addSubscriber(const std::string& topic, const std::string& subscriber) {
    const std::string name = subscriber.substr(subscriber.rfind('/') + 1);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!takesPart(name)) return;
    unmatched_.erase(topic);
    changed_.notify_all();
  }

  /// Blocks until all rebecs have announced themselves, or have begun without this one.
  Beginning agree() {
    awaitAll([this] { return unmatched_; }, "no subscriber on");
    awaitClock();
    announce();
    awaitAll([this] { return missing(); }, "waits for");
    if (!propose().joins) {
      beat();
      awaitAll([this] { return undecided(); }, "waits for");
    }
    const Beginning beginning = settle();
    beat();
    return beginning;
  }

  /// Announces this rebec once more: it lives.
  void beat() const {
    // What was true before must not arrive after what is true now.
    const std::lock_guard<std::mutex> in_order(beating_);
    Announcement announcement;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (stamp_ == 0) return;
      announcement.rebec = self_;
      announcement.stamp = stamp_;
      announcement.zero = zero_;
    }
    announcement.clock = now();
    announcement_.publish(announcement);
  }

  /// The rebecs that were heard once and are not any more.
  std::set<std::string> lost() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    Names names;
    for (const auto& peer : peers_) {
      if (peer.second.lost) names.insert(peer.first);
    }
    return names;
  }

  /// How far the clocks of the others are from this one's, at the most, in seconds.
  double clockOffset() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    int64_t offset = 0;
    for (const auto& peer : peers_) offset = std::max(offset, std::abs(peer.second.offset));
    return static_cast<double>(offset) * 1e-9;
  }

  const std::string& self() const { return self_; }

  void stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }

 private:
  using Names = std::set<std::string>;

  struct Peer {
    int64_t stamp;
    int64_t zero;
    int64_t offset;  // of its clock
    int silence;     // own heartbeats since its last one
    bool lost;
  };

  // Who comes back to a system that runs does not wait for those who are gone.
  template <class Find>
  void awaitAll(Find find, const std::string& problem) {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto done = [&] { return stopping_ || find().empty(); };
    while (!changed_.wait_for(lock, timeout_, done)) {
      report(problem, find());
      if (heard_ != 0) break;
    }
    if (stopping_) throw Stopped();
  }

  void awaitClock() const {
    const ros::WallDuration timeout(timeout_.count());
    while (!ros::Time::waitForValid(timeout)) {
      if (!ros::ok()) throw Stopped();
      report("waits for", {"/clock"});
    }
  }

  void announce() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stamp_ = now();
    }
    beat();
  }

  // Time 0 is when the last one has heard of all the others; who comes later takes it over.
  Beginning propose() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (heard_ != 0 && stamp_ > heard_) return beginning(heard_);
    return beginning(std::max({now(), heard_, latest()}));
  }

  // Of what all have proposed the last moment holds.
  Beginning settle() {
    const std::lock_guard<std::mutex> lock(mutex_);
    settled_ = true;
    return beginning(std::max(zero_, heard_));
  }

  // A time 0 before the own stamp was agreed on without this rebec.
  Beginning beginning(int64_t zero) {
    zero_ = zero;
    return {ros::Time().fromNSec(static_cast<uint64_t>(zero_)), stamp_ > zero_};
  }

  void receive(const Announcement::ConstPtr& announcement) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (announcement->rebec == self_) {
      // Before time 0 is known announcements follow one another at once.
      if (announcement->stamp == stamp_ && announcement->zero != 0) countSilence();
    } else if (takesPart(announcement->rebec)) {
      hear(*announcement);
    }
    changed_.notify_all();
  }

  void hear(const Announcement& announcement) {
    Peer& peer = peers_[announcement.rebec];
    if (peer.lost) report("back", {announcement.rebec});
    const bool again = peer.stamp != 0 && peer.stamp != announcement.stamp;
    const bool late = zero_ != 0 && announcement.stamp > zero_;
    if (again && late) report("restarted", {announcement.rebec});
    const int64_t zero = announcement.zero;
    const bool other = zero != 0 && settled_ && zero != zero_;
    if (other && zero != peer.zero) report("another time 0 than", {announcement.rebec});
    heard_ = std::max(heard_, zero);
    peer = {announcement.stamp, zero, announcement.clock - now(), 0, false};
  }

  // Own heartbeats measure the silence of others: they come late as well where this node does.
  void countSilence() {
    for (auto& peer : peers_) {
      if (++peer.second.silence <= kSilence || peer.second.lost) continue;
      peer.second.lost = true;
      report("lost", {peer.first});
    }
  }

  static int64_t now() { return static_cast<int64_t>(ros::Time::now().toNSec()); }

  bool takesPart(const std::string& name) const {
    return std::find(rebecs_.begin(), rebecs_.end(), name) != rebecs_.end();
  }

  Names missing() const {
    if (heard_ != 0) return {};
    Names names(rebecs_.begin(), rebecs_.end());
    names.erase(self_);
    for (const auto& peer : peers_) names.erase(peer.first);
    return names;
  }

  // Who does not know time 0 yet cannot serve: what is sent to it would only fill its mailbox.
  Names undecided() const {
    Names names(rebecs_.begin(), rebecs_.end());
    names.erase(self_);
    for (const auto& peer : peers_) {
      if (peer.second.zero != 0) names.erase(peer.first);
    }
    return names;
  }

  int64_t latest() const {
    int64_t time = stamp_;
    for (const auto& peer : peers_) time = std::max(time, peer.second.stamp);
    return time;
  }

  void report(const std::string& problem, const Names& names) const {
    std::string facts = problem;
    for (const auto& name : names) facts += " " + name;
    ROS_ERROR_STREAM(reportLine("startup", self_, "startup", facts));
  }

  const std::string self_;
  std::vector<std::string> rebecs_;
  std::chrono::duration<double> timeout_{};
  mutable std::mutex mutex_;
  mutable std::mutex beating_;  // taken before the other
  std::condition_variable changed_;
  Names unmatched_;
  std::map<std::string, Peer> peers_;
  int64_t stamp_ = 0;  // times in nanoseconds of the ROS clock; 0: not yet
  int64_t heard_ = 0;  // the last time 0 that others have proposed
  int64_t zero_ = 0;
  bool settled_ = false;
  bool stopping_ = false;
  ros::Publisher announcement_;
  ros::Subscriber announcements_;
};

}  // namespace running_example

#endif  // RUNNING_EXAMPLE_STARTUP_H
