// Compares what the nodes do with the model patrol.rebeca, and tells on /diagnostics.
//
// It only listens; the system runs the same without it.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <diagnostic_msgs/msg/diagnostic_array.hpp>
#include <rclcpp/rclcpp.hpp>

#include "patrol/monitor_model.hpp"
#include "patrol/monitor_run.hpp"
#include "patrol/msg/announcement.hpp"
#include "patrol/msg/cart_state.hpp"
#include "patrol/msg/station_state.hpp"

namespace {

using patrol::msg::Announcement;
namespace monitoring = patrol::monitoring;
using monitoring::append;

constexpr std::size_t kDepth = 10000;           // messages that may wait in the middleware
constexpr std::chrono::milliseconds kPause{250};  // between looks
constexpr int kLooks = 4;                       // looks between two statuses that say the same

std::vector<monitoring::Cell> cellsOf(const monitoring::Model& model, const patrol::msg::StationState& state) {
  std::vector<monitoring::Cell> cells;
  append(cells, model, state.seen);
  append(cells, model, state.flags);
  return cells;
}

std::vector<monitoring::Cell> cellsOf(const monitoring::Model& model, const patrol::msg::CartState& state) {
  std::vector<monitoring::Cell> cells;
  append(cells, model, state.at);
  append(cells, model, state.last);
  return cells;
}

/// The node.
class Monitor : public rclcpp::Node {
 public:
  Monitor() : rclcpp::Node("monitor"), watch_(monitoring::theModel(), true) {
    watch_.setTimes(declare_parameter<double>("mailbox.time_unit", 1.0),
        declare_parameter<double>("mailbox.slack", 0.5), declare_parameter<double>("patience", 5.0));
    diagnostics_ = create_publisher<diagnostic_msgs::msg::DiagnosticArray>("/diagnostics", 10);
    announcements_ = create_subscription<Announcement>("startup", kept(),
        [this](Announcement::ConstSharedPtr announcement) {
          if (announcement->zero != 0) zero_ = announcement->zero;
        });
    listen<patrol::msg::StationState>(0);
    listen<patrol::msg::CartState>(1);
    timer_ = create_wall_timer(kPause, [this] { look(); });
  }

 private:
  static rclcpp::QoS kept() { return rclcpp::QoS(kDepth).transient_local(); }

  template <class State>
  void listen(std::size_t rebec) {
    const std::string topic = watch_.run().model().rebecs[rebec].node + "/state";
    subscriptions_.push_back(create_subscription<State>(topic, kept(),
        [this, rebec](typename State::ConstSharedPtr state) {
          monitoring::Observation seen = monitoring::observed(rebec, *state);
          seen.variables = cellsOf(watch_.run().model(), *state);
          watch_.receive(seen, zero_ != 0, clock());
        }));
  }

  // Seconds since the common time 0.
  double clock() { return static_cast<double>(now().nanoseconds() - zero_) / 1e9; }

  void look() {
    const monitoring::Status status = watch_.status(zero_ != 0, clock());
    looks_++;
    if (status.level == level_ && looks_ < kLooks) return;
    if (status.level == monitoring::kError && level_ != monitoring::kError) {
      RCLCPP_ERROR_STREAM(get_logger(), status.message);
    }
    if (status.level == monitoring::kWarn && level_ != monitoring::kWarn) {
      RCLCPP_WARN_STREAM(get_logger(), status.message);
    }
    level_ = status.level;
    looks_ = 0;
    publish(status);
  }

  void publish(const monitoring::Status& found) {
    diagnostic_msgs::msg::DiagnosticStatus status;
    status.name = std::string(get_fully_qualified_name()).substr(1) + ": run of the model";
    status.hardware_id = "patrol";
    status.level = static_cast<uint8_t>(found.level);
    status.message = found.message;
    for (const auto& fact : found.facts) {
      diagnostic_msgs::msg::KeyValue pair;
      pair.key = fact.first;
      pair.value = fact.second;
      status.values.push_back(pair);
    }
    diagnostic_msgs::msg::DiagnosticArray diagnostics;
    diagnostics.header.stamp = now();
    diagnostics.status.push_back(status);
    diagnostics_->publish(diagnostics);
  }

  monitoring::Watch watch_;
  rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr diagnostics_;
  rclcpp::Subscription<Announcement>::SharedPtr announcements_;
  std::vector<std::shared_ptr<void>> subscriptions_;
  rclcpp::TimerBase::SharedPtr timer_;
  int64_t zero_ = 0;  // ns
  int level_ = -1;
  int looks_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  try {
    rclcpp::spin(std::make_shared<Monitor>());
  } catch (const rclcpp::exceptions::RCLErrorBase&) {
    if (rclcpp::ok()) throw;  // else it was told to stop while the node was made
  }
  rclcpp::shutdown();
  return 0;
}
