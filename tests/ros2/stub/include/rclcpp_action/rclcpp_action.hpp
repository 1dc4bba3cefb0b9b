// rclcpp_action in one process: goals come from the driver.
// Written by hand for tests; what it accepts is less than what rclcpp_action accepts.
#ifndef REBSYNC_STUB_RCLCPP_ACTION_HPP
#define REBSYNC_STUB_RCLCPP_ACTION_HPP

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/rclcpp.hpp"

namespace rclcpp_action {

using GoalUUID = std::array<uint8_t, 16>;

enum class GoalResponse : int8_t { REJECT = 1, ACCEPT_AND_EXECUTE = 2, ACCEPT_AND_DEFER = 3 };
enum class CancelResponse : int8_t { REJECT = 1, ACCEPT = 2 };

template <class A>
class Server;

template <class A>
class ServerGoalHandle {
 public:
  ServerGoalHandle(
      const GoalUUID& id, rclcpp::fake::Ask ask, const std::shared_ptr<Server<A>>& server)
      : id_(id), ask_(std::move(ask)), server_(server) {}
  // As the real one does with a goal that nobody has ended.
  ~ServerGoalHandle() {
    if (!ended_ && rclcpp::ok()) end("canceled", typename A::Result());
  }

  void publish_feedback(std::shared_ptr<typename A::Feedback> feedback) {
    if (ended_) rclcpp::fake::fail("feedback after the end of a goal");
    if (!server_.expired()) rclcpp::fake::tell(ask_, "feedback", rclcpp::fake::yaml(*feedback));
  }
  void succeed(std::shared_ptr<typename A::Result> result) { end("succeeded", *result); }
  void abort(std::shared_ptr<typename A::Result> result) { end("aborted", *result); }
  const GoalUUID& get_goal_id() const { return id_; }
  bool is_active() const { return !ended_; }

 private:
  // Without its server a goal ends, and nobody is told.
  void end(const char* state, const typename A::Result& result) {
    if (ended_) rclcpp::fake::fail("a goal ends twice");
    ended_ = true;
    if (!server_.expired()) rclcpp::fake::tell(ask_, state, rclcpp::fake::yaml(result));
  }

  const GoalUUID id_;
  const rclcpp::fake::Ask ask_;
  const std::weak_ptr<Server<A>> server_;
  bool ended_ = false;
};

template <class A>
class Server {
 public:
  using SharedPtr = std::shared_ptr<Server<A>>;
  using Handle = ServerGoalHandle<A>;
  using Accept = std::function<GoalResponse(const GoalUUID&, std::shared_ptr<const typename A::Goal>)>;
  using Cancel = std::function<CancelResponse(std::shared_ptr<Handle>)>;
  using Begin = std::function<void(std::shared_ptr<Handle>)>;

  Server(std::shared_ptr<rclcpp::fake::Executor> executor, Accept accept, Cancel cancel, Begin begin)
      : executor_(std::move(executor)),
        accept_(std::move(accept)),
        cancel_(std::move(cancel)),
        begin_(std::move(begin)) {}
  ~Server() { executor_->changes("an action is destroyed"); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  static void take(const SharedPtr& server, const rclcpp::fake::Ask& ask) {
    if (ask.cancels) return server->cancel(ask);
    GoalUUID id{};
    id[0] = ++server->count_;
    const auto goal = rclcpp::fake::read<typename A::Goal>(ask.fields);
    if (server->accept_(id, goal) == GoalResponse::REJECT) {
      return rclcpp::fake::tell(ask, "rejected");
    }
    rclcpp::fake::tell(ask, "accepted");
    const auto handle = std::make_shared<Handle>(id, ask, server);
    server->goals_.push_back(handle);
    server->begin_(handle);
  }

 private:
  void cancel(const rclcpp::fake::Ask& ask) {
    for (const auto& weak : goals_) {
      const auto handle = weak.lock();
      if (!handle || !handle->is_active()) continue;
      const bool accepted = cancel_(handle) == CancelResponse::ACCEPT;
      rclcpp::fake::tell(ask, accepted ? "cancelling" : "not cancelled");
    }
  }

  const std::shared_ptr<rclcpp::fake::Executor> executor_;
  const Accept accept_;
  const Cancel cancel_;
  const Begin begin_;
  uint8_t count_ = 0;
  std::vector<std::weak_ptr<Handle>> goals_;
};

template <class A, class NodeT>
typename Server<A>::SharedPtr create_server(NodeT node, const std::string& name,
    typename Server<A>::Accept accept, typename Server<A>::Cancel cancel,
    typename Server<A>::Begin begin) {
  const auto* base = node->get_node_base_interface();
  const auto executor = base->fake_executor();
  executor->changes("an action is made");
  const auto server = std::make_shared<Server<A>>(
      executor, std::move(accept), std::move(cancel), std::move(begin));
  const std::weak_ptr<Server<A>> weak = server;
  rclcpp::fake::offers().add(
      base->resolve_topic_name(name), weak, [weak, executor](const rclcpp::fake::Ask& ask) {
        executor->post([weak, ask] {
          if (const auto held = weak.lock()) Server<A>::take(held, ask);
        });
      });
  return server;
}

}  // namespace rclcpp_action

#endif  // REBSYNC_STUB_RCLCPP_ACTION_HPP
