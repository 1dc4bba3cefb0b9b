#include <chrono>
#include <mesh/session.hpp>
#include <std_msgs/msg/int32.hpp>

class Beat : public mesh::Session {
 public:
  Beat() : Session("beat") {
    step_ = parameter("step", 2);
    pub_ = declare_publisher<std_msgs::msg::Int32>("beats", 10);
    timer_ = every(std::chrono::milliseconds(3000), std::bind(&Beat::tick, this));
    echo_ = declare_subscriber<std_msgs::msg::Int32>(
        "beats", std::bind(&Beat::heard, this, std::placeholders::_1));
  }

 private:
  void tick() {
    count_ = step_;
    std_msgs::msg::Int32 message;
    message.data = count_;
    pub_.put(message);
    mesh::log_info("beat %d", count_);
  }

  void heard(const std_msgs::msg::Int32& message) {
    if (message.data == 2) {
      mesh::pause(1);
      heard_ = true;
    }
  }

  mesh::Publisher<std_msgs::msg::Int32> pub_;
  mesh::Subscriber echo_;
  mesh::Timer timer_;
  int step_ = 0;
  int count_ = 0;
  bool heard_ = false;
};

int main() {
  Beat beat;
  beat.run();
}
