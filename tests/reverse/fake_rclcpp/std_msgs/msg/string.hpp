#pragma once
#include <memory>
#include <string>
namespace std_msgs::msg {
struct String {
  using SharedPtr = std::shared_ptr<String>;
  using ConstSharedPtr = std::shared_ptr<const String>;
  using UniquePtr = std::unique_ptr<String>;
  std::string data{};
  String& set__data(std::string value) {
    data = value;
    return *this;
  }
};
}  // namespace std_msgs::msg
