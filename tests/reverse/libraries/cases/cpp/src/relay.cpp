#include <chrono>
#include <mesh/session.hpp>
#include <std_msgs/msg/int32.hpp>

class Relay {
 public:
  explicit Relay(mesh::Session& session) : session_(session) {
    limit_ = session_.parameter("limit", 3);
    pub_ = session_.declare_publisher<std_msgs::msg::Int32>("out", 10);
    sub_ = session_.declare_subscriber<std_msgs::msg::Int32>(
        "in", [this](const std_msgs::msg::Int32& message) { on(message); });
    timer_ = session_.every(std::chrono::seconds(2), [this]() { tick(); });
  }

 private:
  void on(const std_msgs::msg::Int32& message) {
    if (message.data < limit_) {
      count_ = message.data;
      mesh::log_info("took %d", count_);
    }
  }

  void tick() {
    std_msgs::msg::Int32 message;
    message.data = count_;
    pub_.put(message);
  }

  mesh::Session& session_;
  mesh::Publisher<std_msgs::msg::Int32> pub_;
  mesh::Subscriber sub_;
  mesh::Timer timer_;
  int limit_ = 0;
  int count_ = 0;
};

class Sink {
 public:
  explicit Sink(mesh::Session& session) {
    sub_ = session.declare_subscriber<std_msgs::msg::Int32>(
        "out", [this](const std_msgs::msg::Int32& message) { last_ = message.data; });
  }

 private:
  mesh::Subscriber sub_;
  int last_ = 0;
};

int main() {
  mesh::Session session("relay");
  Relay relay(session);
  Sink sink(session);
  session.run();
}
