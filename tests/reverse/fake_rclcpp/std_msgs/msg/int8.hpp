#pragma once
#include <memory>
#include <string>
namespace std_msgs::msg {
struct Int8 {
  using SharedPtr = std::shared_ptr<Int8>;
  using ConstSharedPtr = std::shared_ptr<const Int8>;
  using UniquePtr = std::unique_ptr<Int8>;
  int8_t data{};
  Int8& set__data(int8_t value) {
    data = value;
    return *this;
  }
};
}  // namespace std_msgs::msg
