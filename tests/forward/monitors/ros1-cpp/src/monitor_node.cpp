// Compares what the nodes do with the model patrol.rebeca, and tells on /diagnostics.
//
// It only listens; the system runs the same without it.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "patrol/Announcement.h"
#include "patrol/CartState.h"
#include "patrol/StationState.h"
#include "patrol/monitor_model.h"
#include "patrol/monitor_run.h"

namespace {

using patrol::Announcement;
namespace monitoring = patrol::monitoring;
using monitoring::append;

constexpr uint32_t kDepth = 10000;  // messages that may wait in the middleware
constexpr double kPause = 0.25;     // s between looks
constexpr int kLooks = 4;           // looks between two statuses that say the same

std::vector<monitoring::Cell> cellsOf(const monitoring::Model& model, const patrol::StationState& state) {
  std::vector<monitoring::Cell> cells;
  append(cells, model, state.seen);
  append(cells, model, state.flags);
  return cells;
}

std::vector<monitoring::Cell> cellsOf(const monitoring::Model& model, const patrol::CartState& state) {
  std::vector<monitoring::Cell> cells;
  append(cells, model, state.at);
  append(cells, model, state.last);
  return cells;
}

/// The node.
class Monitor {
 public:
  Monitor() : watch_(monitoring::theModel(), true) {
    diagnostics_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
    announcements_ = node_.subscribe("startup", 1000, &Monitor::hear, this);
    listen<patrol::StationState>(0);
    listen<patrol::CartState>(1);
    timer_ = node_.createWallTimer(ros::WallDuration(kPause), &Monitor::look, this);
  }

 private:
  template <class State>
  void listen(std::size_t rebec) {
    using Received = boost::shared_ptr<const State>;
    const boost::function<void(const Received&)> receive = [this, rebec](const Received& state) {
      monitoring::Observation seen = monitoring::observed(rebec, *state);
      seen.variables = cellsOf(watch_.run().model(), *state);
      if (!connected_) checkConnected();
      watch_.receive(seen, zero_ != 0, clock());
    };
    const std::string topic = watch_.run().model().rebecs[rebec].node + "/state";
    subscribers_.push_back(node_.subscribe<State>(topic, kDepth, receive, ros::VoidConstPtr(),
        ros::TransportHints().tcpNoDelay()));
  }

  // A rebec without a constructor may have served something before it is heard.
  void checkConnected() {
    connected_ = true;
    for (const std::size_t rebec : std::vector<std::size_t>{}) {
      if (subscribers_[rebec].getNumPublishers() == 0) watch_.run().miss(rebec);
    }
  }

  void hear(const Announcement::ConstPtr& announcement) {
    if (announcement->zero == 0 || announcement->zero == zero_) return;
    zero_ = announcement->zero;
    // The launch file of the system has loaded them by now.
    watch_.setTimes(node_.param("mailbox/time_unit", 1.0), node_.param("mailbox/slack", 0.5),
        ros::NodeHandle("~").param("patience", 5.0));
  }

  // Seconds since the common time 0.
  double clock() const {
    return static_cast<double>(static_cast<int64_t>(ros::Time::now().toNSec()) - zero_) / 1e9;
  }

  void look(const ros::WallTimerEvent& /* event */) {
    const monitoring::Status status = watch_.status(zero_ != 0, clock());
    looks_++;
    if (status.level == level_ && looks_ < kLooks) return;
    if (status.level == monitoring::kError && level_ != monitoring::kError) ROS_ERROR_STREAM(status.message);
    if (status.level == monitoring::kWarn && level_ != monitoring::kWarn) ROS_WARN_STREAM(status.message);
    level_ = status.level;
    looks_ = 0;
    publish(status);
  }

  void publish(const monitoring::Status& found) {
    diagnostic_msgs::DiagnosticStatus status;
    status.name = ros::this_node::getName().substr(1) + ": run of the model";
    status.hardware_id = "patrol";
    status.level = static_cast<int8_t>(found.level);
    status.message = found.message;
    for (const auto& fact : found.facts) {
      diagnostic_msgs::KeyValue pair;
      pair.key = fact.first;
      pair.value = fact.second;
      status.values.push_back(pair);
    }
    diagnostic_msgs::DiagnosticArray diagnostics;
    diagnostics.header.stamp = ros::Time::now();
    diagnostics.status.push_back(status);
    diagnostics_.publish(diagnostics);
  }

  ros::NodeHandle node_;
  monitoring::Watch watch_;
  ros::Publisher diagnostics_;
  ros::Subscriber announcements_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
  int64_t zero_ = 0;  // ns
  bool connected_ = false;
  int level_ = -1;
  int looks_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "monitor");
  const Monitor monitor;
  ros::spin();
  return 0;
}
