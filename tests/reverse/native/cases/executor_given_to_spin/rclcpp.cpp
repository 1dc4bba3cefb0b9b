#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class N : public rclcpp::Node {
 public:
  N() : Node("n") {
    pub_ = create_publisher<Int32>("out", 9);
    sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
    group_ = create_callback_group(rclcpp::CallbackGroupType::Reentrant);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this] { tick(); }, group_);
  }

 private:
  void cb(const Int32&) {
    x_ = 1;
    busy_ = true;
    get_clock()->sleep_for(rclcpp::Duration(3, 0));
    busy_ = false;
    put(x_);
  }

  void tick() {
    if (busy_) x_ = 3;
  }

  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  rclcpp::Subscription<Int32>::SharedPtr sub_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::TimerBase::SharedPtr timer_;
  int x_ = 0;
  bool busy_ = false;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  using Threads = rclcpp::executors::MultiThreadedExecutor;
  auto node = std::make_shared<N>();
  Threads executor;
  executor.add_node(node);
  executor.spin();
  rclcpp::shutdown();
}
