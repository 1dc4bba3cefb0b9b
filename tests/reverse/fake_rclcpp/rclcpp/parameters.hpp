// See ../README.md.
#pragma once

#include <functional>
#include <memory>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace rclcpp {

enum class ParameterType { PARAMETER_NOT_SET, PARAMETER_BOOL, PARAMETER_INTEGER, PARAMETER_DOUBLE, PARAMETER_STRING };
constexpr auto PARAMETER_INTEGER = ParameterType::PARAMETER_INTEGER;

class ParameterValue {
 public:
  using Held = std::variant<std::monostate, bool, int64_t, double, std::string, std::vector<int64_t>>;
  ParameterValue() = default;
  template <class T>
  explicit ParameterValue(const T& value) {
    if constexpr (std::is_same_v<T, bool>) held_ = value;
    else if constexpr (std::is_integral_v<T>) held_ = int64_t{value};
    else if constexpr (std::is_floating_point_v<T>) held_ = double{value};
    else if constexpr (std::is_same_v<T, std::vector<int64_t>>) held_ = value;
    else held_ = std::string(value);
  }
  template <class T>
  auto get() const {
    if constexpr (std::is_same_v<T, bool>) return std::get<bool>(held_);
    else if constexpr (std::is_integral_v<T>) return static_cast<T>(std::get<int64_t>(held_));
    else if constexpr (std::is_floating_point_v<T>) return static_cast<T>(std::get<double>(held_));
    else return std::get<T>(held_);
  }
  bool is_set() const { return held_.index() != 0; }

 private:
  Held held_;
};

class Parameter {
 public:
  Parameter() = default;
  template <class T>
  Parameter(std::string name, const T& value) : name_(std::move(name)), value_(value) {}
  Parameter(std::string name, const ParameterValue& value) : name_(std::move(name)), value_(value) {}
  const std::string& get_name() const { return name_; }
  int64_t as_int() const { return value_.get<int64_t>(); }
  bool as_bool() const { return value_.get<bool>(); }
  double as_double() const { return value_.get<double>(); }
  std::string as_string() const { return value_.get<std::string>(); }
  std::vector<int64_t> as_integer_array() const { return value_.get<std::vector<int64_t>>(); }
  template <class T>
  T get_value() const { return value_.get<T>(); }
  const ParameterValue& get_parameter_value() const { return value_; }
  ParameterType get_type() const { return ParameterType::PARAMETER_INTEGER; }

 private:
  std::string name_;
  ParameterValue value_;
};

using OnSet = std::function<rcl_interfaces::msg::SetParametersResult(const std::vector<Parameter>&)>;

namespace node_interfaces {
struct OnSetParametersCallbackHandle {
  using SharedPtr = std::shared_ptr<OnSetParametersCallbackHandle>;
  OnSet callback;
};
struct PostSetParametersCallbackHandle {
  using SharedPtr = std::shared_ptr<PostSetParametersCallbackHandle>;
  std::function<void(const std::vector<Parameter>&)> callback;
};
}  // namespace node_interfaces

}  // namespace rclcpp
