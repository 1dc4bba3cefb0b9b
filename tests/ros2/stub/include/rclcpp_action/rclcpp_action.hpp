// What generated packages use of rclcpp_action; nobody sends goals.
#ifndef REBSYNC_STUB_RCLCPP_ACTION_HPP
#define REBSYNC_STUB_RCLCPP_ACTION_HPP

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "rclcpp/rclcpp.hpp"

namespace rclcpp_action {

using GoalUUID = std::array<uint8_t, 16>;

enum class GoalResponse : int8_t { REJECT = 1, ACCEPT_AND_EXECUTE = 2, ACCEPT_AND_DEFER = 3 };
enum class CancelResponse : int8_t { REJECT = 1, ACCEPT = 2 };

template <class A>
class ServerGoalHandle {
 public:
  void publish_feedback(std::shared_ptr<typename A::Feedback>) {}
  void succeed(std::shared_ptr<typename A::Result>) {}
  void abort(std::shared_ptr<typename A::Result>) {}
  const GoalUUID& get_goal_id() const { return id_; }

 private:
  GoalUUID id_{};
};

template <class A>
class Server {
 public:
  using SharedPtr = std::shared_ptr<Server<A>>;
};

template <class A, class N>
typename Server<A>::SharedPtr create_server(N, const std::string&,
    std::function<GoalResponse(const GoalUUID&, std::shared_ptr<const typename A::Goal>)>,
    std::function<CancelResponse(std::shared_ptr<ServerGoalHandle<A>>)>,
    std::function<void(std::shared_ptr<ServerGoalHandle<A>>)>) {
  return std::make_shared<Server<A>>();
}

}  // namespace rclcpp_action

#endif  // REBSYNC_STUB_RCLCPP_ACTION_HPP
