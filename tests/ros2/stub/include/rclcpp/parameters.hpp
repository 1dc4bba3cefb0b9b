// Parameters: declared once, with a type that what overrides them must have.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace rclcpp {

namespace exceptions {

struct ParameterAlreadyDeclaredException : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct InvalidParameterTypeException : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct InvalidQosOverridesException : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct RCLErrorBase {
  virtual ~RCLErrorBase() = default;
};
struct RCLError : RCLErrorBase, std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace exceptions

class ParameterValue {
 public:
  using Any = std::variant<bool, int64_t, double, std::string, std::vector<bool>,
      std::vector<int64_t>, std::vector<double>, std::vector<std::string>>;

  explicit ParameterValue(bool value) : value_(value) {}
  explicit ParameterValue(int value) : value_(int64_t{value}) {}
  explicit ParameterValue(int64_t value) : value_(value) {}
  explicit ParameterValue(double value) : value_(value) {}
  explicit ParameterValue(const std::string& value) : value_(value) {}
  explicit ParameterValue(const std::vector<bool>& value) : value_(value) {}
  explicit ParameterValue(const std::vector<int64_t>& value) : value_(value) {}
  explicit ParameterValue(const std::vector<double>& value) : value_(value) {}
  explicit ParameterValue(const std::vector<std::string>& value) : value_(value) {}

  template <class T>
  T get() const {
    if constexpr (std::is_same_v<T, int>) {
      return static_cast<int>(std::get<int64_t>(value_));
    } else {
      return std::get<T>(value_);
    }
  }
  bool has_type_of(const ParameterValue& other) const {
    return value_.index() == other.value_.index();
  }

 private:
  Any value_;
};

class Parameter {
 public:
  Parameter(std::string name, ParameterValue value)
      : name_(std::move(name)), value_(std::move(value)) {}
  const std::string& get_name() const { return name_; }
  const ParameterValue& get_parameter_value() const { return value_; }
  std::vector<std::string> as_string_array() const {
    return value_.get<std::vector<std::string>>();
  }

 private:
  std::string name_;
  ParameterValue value_;
};

}  // namespace rclcpp
