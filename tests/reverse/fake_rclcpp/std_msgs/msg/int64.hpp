#pragma once
#include <memory>
#include <string>
namespace std_msgs::msg {
struct Int64 {
  using SharedPtr = std::shared_ptr<Int64>;
  using ConstSharedPtr = std::shared_ptr<const Int64>;
  using UniquePtr = std::unique_ptr<Int64>;
  int64_t data{};
  Int64& set__data(int64_t value) {
    data = value;
    return *this;
  }
};
}  // namespace std_msgs::msg
