#pragma once
#include <cstdint>
#include <memory>
#include <string>
namespace diagnostic_msgs::msg {
struct DiagnosticStatus {
  using SharedPtr = std::shared_ptr<DiagnosticStatus>;
  static constexpr uint8_t OK = 0, WARN = 1, ERROR = 2, STALE = 3;
  uint8_t level = 0;
  std::string name, message;
};
}  // namespace diagnostic_msgs::msg
