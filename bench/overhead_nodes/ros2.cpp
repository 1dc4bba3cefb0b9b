// The ping-pong as one writes it by hand, with the messages of the generated package: a or b.
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include <ping/msg/pinger_ping.hpp>
#include <ping/msg/pinger_state.hpp>
#include <ping/msg/ponger_pong.hpp>
#include <ping/msg/ponger_state.hpp>
#include <ping/msg/referee_mark.hpp>
#include <rclcpp/rclcpp.hpp>

using namespace std::chrono_literals;

class Pinger : public rclcpp::Node {
 public:
  Pinger() : rclcpp::Node("a") {
    pong_ = create_publisher<ping::msg::PongerPong>("b/pong", 1000);
    mark_ = create_publisher<ping::msg::RefereeMark>("c/mark", 1000);
    const auto kept = rclcpp::QoS(1000).transient_local();
    state_ = create_publisher<ping::msg::PingerState>("a/state", kept);
    subscription_ = create_subscription<ping::msg::PingerPing>("a/ping", 1000,
        [this](ping::msg::PingerPing::ConstSharedPtr) { serve(); });
  }

  void begin() {
    while (rclcpp::ok() && pong_->get_subscription_count() == 0) std::this_thread::sleep_for(50ms);
    std::this_thread::sleep_for(1s);  // until the other hears, too
    serve();
  }

 private:
  void serve() {
    ++n_;
    if (n_ % 200 == 0) {
      ping::msg::RefereeMark mark;
      mark.k = n_;
      mark_->publish(mark);
    }
    ping::msg::PongerPong message;
    message.k = n_;
    pong_->publish(message);
    ping::msg::PingerState state;
    state.server = "ping";
    state.n = n_;
    state_->publish(state);
  }

  int n_ = 0;
  rclcpp::Publisher<ping::msg::PongerPong>::SharedPtr pong_;
  rclcpp::Publisher<ping::msg::RefereeMark>::SharedPtr mark_;
  rclcpp::Publisher<ping::msg::PingerState>::SharedPtr state_;
  rclcpp::Subscription<ping::msg::PingerPing>::SharedPtr subscription_;
};

class Ponger : public rclcpp::Node {
 public:
  Ponger() : rclcpp::Node("b") {
    ping_ = create_publisher<ping::msg::PingerPing>("a/ping", 1000);
    const auto kept = rclcpp::QoS(1000).transient_local();
    state_ = create_publisher<ping::msg::PongerState>("b/state", kept);
    subscription_ = create_subscription<ping::msg::PongerPong>("b/pong", 1000,
        [this](ping::msg::PongerPong::ConstSharedPtr message) { receive(*message); });
  }

 private:
  void receive(const ping::msg::PongerPong& message) {
    ping_->publish(ping::msg::PingerPing());
    ping::msg::PongerState state;
    state.server = "pong";
    state.arguments = std::to_string(message.k);
    state.n = message.k;
    state_->publish(state);
  }

  rclcpp::Publisher<ping::msg::PingerPing>::SharedPtr ping_;
  rclcpp::Publisher<ping::msg::PongerState>::SharedPtr state_;
  rclcpp::Subscription<ping::msg::PongerPong>::SharedPtr subscription_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  if (std::string(argv[1]) == "a") {
    const auto pinger = std::make_shared<Pinger>();
    pinger->begin();
    rclcpp::spin(pinger);
  } else {
    rclcpp::spin(std::make_shared<Ponger>());
  }
  rclcpp::shutdown();
  return 0;
}
