#pragma once
#include <memory>
#include <string>
namespace std_msgs::msg {
struct UInt8 {
  using SharedPtr = std::shared_ptr<UInt8>;
  using ConstSharedPtr = std::shared_ptr<const UInt8>;
  using UniquePtr = std::unique_ptr<UInt8>;
  uint8_t data{};
  UInt8& set__data(uint8_t value) {
    data = value;
    return *this;
  }
};
}  // namespace std_msgs::msg
