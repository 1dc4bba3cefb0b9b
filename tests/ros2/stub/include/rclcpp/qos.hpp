// Qualities of service, as far as the fake carries them.
#pragma once

#include <cstddef>

namespace rclcpp {

enum class DurabilityPolicy { SystemDefault, TransientLocal, Volatile };
enum class ReliabilityPolicy { SystemDefault, BestEffort, Reliable };
enum class HistoryPolicy { SystemDefault, KeepLast, KeepAll };

struct KeepLast {
  explicit KeepLast(std::size_t count) : depth(count) {}
  std::size_t depth;
};

class QoS {
 public:
  QoS(std::size_t depth) : depth_(depth) {}  // NOLINT: as in rclcpp
  explicit QoS(const KeepLast& history) : depth_(history.depth) {}

  QoS& reliable() {
    reliability_ = ReliabilityPolicy::Reliable;
    return *this;
  }
  QoS& best_effort() {
    reliability_ = ReliabilityPolicy::BestEffort;
    return *this;
  }
  QoS& transient_local() {
    durability_ = DurabilityPolicy::TransientLocal;
    return *this;
  }

  QoS& depth(std::size_t depth) {
    depth_ = depth;
    return *this;
  }
  QoS& history(HistoryPolicy history) {
    history_ = history;
    return *this;
  }
  QoS& reliability(ReliabilityPolicy reliability) {
    reliability_ = reliability;
    return *this;
  }
  QoS& durability(DurabilityPolicy durability) {
    durability_ = durability;
    return *this;
  }

  std::size_t depth() const { return depth_; }
  HistoryPolicy history() const { return history_; }
  DurabilityPolicy durability() const { return durability_; }
  ReliabilityPolicy reliability() const { return reliability_; }

 private:
  std::size_t depth_;
  HistoryPolicy history_ = HistoryPolicy::KeepLast;
  DurabilityPolicy durability_ = DurabilityPolicy::Volatile;
  ReliabilityPolicy reliability_ = ReliabilityPolicy::Reliable;
};

class SensorDataQoS : public QoS {
 public:
  SensorDataQoS() : QoS(5) { best_effort(); }
};

/// Whether what one side offers is what the other asks for.
inline bool match(const QoS& offered, const QoS& requested) {
  const bool kept = offered.durability() == DurabilityPolicy::TransientLocal ||
      requested.durability() != DurabilityPolicy::TransientLocal;
  const bool safe = offered.reliability() == ReliabilityPolicy::Reliable ||
      requested.reliability() != ReliabilityPolicy::Reliable;
  return kept && safe;
}

}  // namespace rclcpp
