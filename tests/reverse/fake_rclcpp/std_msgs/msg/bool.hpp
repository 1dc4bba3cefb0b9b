#pragma once
#include <memory>
#include <string>
namespace std_msgs::msg {
struct Bool {
  using SharedPtr = std::shared_ptr<Bool>;
  using ConstSharedPtr = std::shared_ptr<const Bool>;
  using UniquePtr = std::unique_ptr<Bool>;
  bool data{};
  Bool& set__data(bool value) {
    data = value;
    return *this;
  }
};
}  // namespace std_msgs::msg
