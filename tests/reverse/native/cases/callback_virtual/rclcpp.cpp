#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

using std_msgs::msg::Int32;

class Base : public rclcpp::Node {
 public:
  Base() : Node("n") {
    base_sub_ = create_subscription<Int32>("inp", 9, [this](const Int32& m) { cb(m); });
  }

 protected:
  virtual void cb(const Int32&) {}

 private:
  rclcpp::Subscription<Int32>::SharedPtr base_sub_;
};

class N : public Base {
 public:
  N() : Base() {
    pub_ = create_publisher<Int32>("out", 9);
  }

 private:
  void cb(const Int32&) override { put(5); }

  void put(int value) {
    Int32 msg;
    msg.data = value;
    pub_->publish(msg);
  }

  rclcpp::Publisher<Int32>::SharedPtr pub_;
  int x_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<N>());
  rclcpp::shutdown();
}
