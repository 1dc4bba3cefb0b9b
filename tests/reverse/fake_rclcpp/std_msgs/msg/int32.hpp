#pragma once
#include <memory>
#include <string>
namespace std_msgs::msg {
struct Int32 {
  using SharedPtr = std::shared_ptr<Int32>;
  using ConstSharedPtr = std::shared_ptr<const Int32>;
  using UniquePtr = std::unique_ptr<Int32>;
  int32_t data{};
  Int32& set__data(int32_t value) {
    data = value;
    return *this;
  }
};
}  // namespace std_msgs::msg
