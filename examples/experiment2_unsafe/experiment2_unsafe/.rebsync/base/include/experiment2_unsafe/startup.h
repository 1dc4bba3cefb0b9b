// The common start of all rebecs: once everyone listens to everyone, time 0 is agreed on.
#ifndef EXPERIMENT2_UNSAFE_STARTUP_H
#define EXPERIMENT2_UNSAFE_STARTUP_H

#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <algorithm>
#include <boost/optional.hpp>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace experiment2_unsafe {

/// Thrown through a body when the node shuts down, so that nothing is sent too early.
struct Stopped {};

/// One line for the log, the same for everything that is reported.
inline std::string reportLine(const std::string& kind, const std::string& rebec,
    const std::string& server, const std::string& facts) {
  return kind + ": " + rebec + "." + server + " (" + facts + ")";
}

/// Announces this rebec when its publishers are matched and waits for all the others.
class Startup {
 public:
  explicit Startup(std::string self) : self_(std::move(self)) {
    ros::NodeHandle node;
    node.getParam("mailbox/rebecs", rebecs_);
    if (rebecs_.empty()) rebecs_.push_back(self_);
    timeout_ = std::chrono::duration<double>(node.param("mailbox/startup_timeout", 30.0));
    announcement_ = node.advertise<std_msgs::Header>("startup", 1, true);
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

  /// Blocks until all rebecs have announced themselves, and returns the common time 0.
  ros::Time agree() {
    awaitAll([this] { return unmatched_; }, "no subscriber on");
    awaitClock();
    announce();
    awaitAll([this] { return missing(); }, "waits for");
    const std::lock_guard<std::mutex> lock(mutex_);
    return *(zero_ = latest());
  }

  void stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }

 private:
  using Names = std::set<std::string>;

  template <class Find>
  void awaitAll(Find find, const std::string& problem) {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto done = [&] { return stopping_ || find().empty(); };
    while (!changed_.wait_for(lock, timeout_, done)) report(problem, find());
    if (stopping_) throw Stopped();
  }

  void awaitClock() const {
    const ros::WallDuration timeout(timeout_.count());
    while (!ros::Time::waitForValid(timeout)) {
      if (!ros::ok()) throw Stopped();
      report("waits for", {"/clock"});
    }
  }

  void announce() const {
    std_msgs::Header header;
    header.stamp = ros::Time::now();
    header.frame_id = self_;
    announcement_.publish(header);
  }

  void receive(const std_msgs::Header::ConstPtr& header) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!takesPart(header->frame_id)) return;
    if (zero_ && header->stamp > *zero_) report("restarted", {header->frame_id});
    stamps_[header->frame_id] = header->stamp;
    changed_.notify_all();
  }

  bool takesPart(const std::string& name) const {
    return std::find(rebecs_.begin(), rebecs_.end(), name) != rebecs_.end();
  }

  Names missing() const {
    Names names(rebecs_.begin(), rebecs_.end());
    for (const auto& stamp : stamps_) names.erase(stamp.first);
    return names;
  }

  ros::Time latest() const {
    ros::Time time;
    for (const auto& stamp : stamps_) time = std::max(time, stamp.second);
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
  std::mutex mutex_;
  std::condition_variable changed_;
  Names unmatched_;
  std::map<std::string, ros::Time> stamps_;
  boost::optional<ros::Time> zero_;
  bool stopping_ = false;
  ros::Publisher announcement_;
  ros::Subscriber announcements_;
};

}  // namespace experiment2_unsafe

#endif  // EXPERIMENT2_UNSAFE_STARTUP_H
