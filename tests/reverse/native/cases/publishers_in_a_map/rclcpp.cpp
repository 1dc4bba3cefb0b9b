#include <map>

#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;
using namespace std::chrono_literals;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
    for (const std::string name : {"out", "log"}) pubs_[name] = create_publisher<Int32>(name, 9);
  }

 private:
  void cb(const Int32&) {
    Int32 msg;
    msg.data = 3;
    pubs_.at("out")->publish(msg);
    msg.data = 4;
    pubs_["log"]->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  std::map<std::string, rclcpp::Publisher<Int32>::SharedPtr> pubs_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
