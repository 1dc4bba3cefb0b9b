#pragma once
#include <string>
namespace rcl_interfaces::msg {
struct SetParametersResult {
  bool successful = false;
  std::string reason;
};
struct ParameterDescriptor {
  std::string name, description;
  bool read_only = false, dynamic_typing = false;
};
}  // namespace rcl_interfaces::msg
