// Counts what happens; the journal is here.
#include <functional>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

class Counter;
void journal() {
  RCLCPP_INFO(rclcpp::get_logger("counter"), "counted");
}

class Counter : public rclcpp::Node {
 public:
  Counter() : Node("counter") {
    count_ = create_publisher<std_msgs::msg::Int32>("count", 1);
    timer_ = create_wall_timer(std::chrono::seconds(1), std::bind(&Counter::tick, this));
  }

 private:
  friend void journal();
  void tick() {
    journal();
    std_msgs::msg::Int32 out;
    out.data = counted_;
    count_->publish(out);
  }

  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr count_;
  rclcpp::TimerBase::SharedPtr timer_;
  int counted_ = 0;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Counter>());
  rclcpp::shutdown();
}
