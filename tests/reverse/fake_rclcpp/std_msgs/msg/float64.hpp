#pragma once
#include <memory>
#include <string>
namespace std_msgs::msg {
struct Float64 {
  using SharedPtr = std::shared_ptr<Float64>;
  using ConstSharedPtr = std::shared_ptr<const Float64>;
  using UniquePtr = std::unique_ptr<Float64>;
  double data{};
  Float64& set__data(double value) {
    data = value;
    return *this;
  }
};
}  // namespace std_msgs::msg
