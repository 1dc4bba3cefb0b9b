// Parameters that override qualities of service: `qos_overrides./topic.publisher.depth` and others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <rclcpp/parameters.hpp>
#include <rclcpp/qos.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rclcpp {

enum class QosPolicyKind {
  AvoidRosNamespaceConventions,
  Deadline,
  Depth,
  Durability,
  History,
  Lifespan,
  Liveliness,
  LivelinessLeaseDuration,
  Reliability,
};

using QosCallbackResult = rcl_interfaces::msg::SetParametersResult;
using QosCallback = std::function<QosCallbackResult(const QoS&)>;

class QosOverridingOptions {
 public:
  QosOverridingOptions() = default;
  QosOverridingOptions(  // NOLINT: as in rclcpp
      std::initializer_list<QosPolicyKind> kinds, QosCallback check = nullptr)
      : kinds_(kinds), check_(std::move(check)) {}

  static QosOverridingOptions with_default_policies(QosCallback check = nullptr) {
    using Kind = QosPolicyKind;
    return {{Kind::History, Kind::Depth, Kind::Reliability}, std::move(check)};
  }

  const std::vector<QosPolicyKind>& get_policy_kinds() const { return kinds_; }
  const QosCallback& get_validation_callback() const { return check_; }

 private:
  std::vector<QosPolicyKind> kinds_;
  QosCallback check_;
};

struct PublisherOptions {
  QosOverridingOptions qos_overriding_options;
};

struct SubscriptionOptions {
  QosOverridingOptions qos_overriding_options;
};

namespace fake {

template <class Policy>
using Names = std::map<std::string, Policy>;

inline const Names<HistoryPolicy> kHistories{{"system_default", HistoryPolicy::SystemDefault},
    {"keep_last", HistoryPolicy::KeepLast}, {"keep_all", HistoryPolicy::KeepAll}};
inline const Names<ReliabilityPolicy> kReliabilities{
    {"system_default", ReliabilityPolicy::SystemDefault},
    {"best_effort", ReliabilityPolicy::BestEffort}, {"reliable", ReliabilityPolicy::Reliable}};
inline const Names<DurabilityPolicy> kDurabilities{
    {"system_default", DurabilityPolicy::SystemDefault},
    {"transient_local", DurabilityPolicy::TransientLocal}, {"volatile", DurabilityPolicy::Volatile}};

template <class Policy>
std::string key(const Names<Policy>& names, Policy wanted) {
  for (const auto& [name, policy] : names) {
    if (policy == wanted) return name;
  }
  throw std::invalid_argument("unknown value of a policy");
}

template <class Policy>
Policy named(const Names<Policy>& names, const ParameterValue& value) {
  const auto found = names.find(value.get<std::string>());
  if (found == names.end()) throw std::invalid_argument("unknown value of a QoS policy");
  return found->second;
}

inline std::string name_of(QosPolicyKind kind) {
  static const std::map<QosPolicyKind, std::string> names{
      {QosPolicyKind::AvoidRosNamespaceConventions, "avoid_ros_namespace_conventions"},
      {QosPolicyKind::Deadline, "deadline"},
      {QosPolicyKind::Depth, "depth"},
      {QosPolicyKind::Durability, "durability"},
      {QosPolicyKind::History, "history"},
      {QosPolicyKind::Lifespan, "lifespan"},
      {QosPolicyKind::Liveliness, "liveliness"},
      {QosPolicyKind::LivelinessLeaseDuration, "liveliness_lease_duration"},
      {QosPolicyKind::Reliability, "reliability"},
  };
  return names.at(kind);
}

/// The value of a policy as a parameter; what the stub does not carry has the default of rclcpp.
inline ParameterValue value_of(QosPolicyKind kind, const QoS& qos) {
  switch (kind) {
    case QosPolicyKind::Depth:
      return ParameterValue(static_cast<int64_t>(qos.depth()));
    case QosPolicyKind::History:
      return ParameterValue(key(kHistories, qos.history()));
    case QosPolicyKind::Reliability:
      return ParameterValue(key(kReliabilities, qos.reliability()));
    case QosPolicyKind::Durability:
      return ParameterValue(key(kDurabilities, qos.durability()));
    case QosPolicyKind::Liveliness:
      return ParameterValue(std::string("system_default"));
    case QosPolicyKind::AvoidRosNamespaceConventions:
      return ParameterValue(false);
    default:
      return ParameterValue(int64_t{0});
  }
}

inline void set(QosPolicyKind kind, const ParameterValue& value, QoS& qos) {
  switch (kind) {
    case QosPolicyKind::Depth:
      qos.depth(static_cast<std::size_t>(value.get<int64_t>()));
      break;
    case QosPolicyKind::History:
      qos.history(named(kHistories, value));
      break;
    case QosPolicyKind::Reliability:
      qos.reliability(named(kReliabilities, value));
      break;
    case QosPolicyKind::Durability:
      qos.durability(named(kDurabilities, value));
      break;
    default:
      break;
  }
}

}  // namespace fake

}  // namespace rclcpp
