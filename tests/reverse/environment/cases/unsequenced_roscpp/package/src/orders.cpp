// Publishes sums whose operands C++ evaluates in any order.
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Int32.h>

namespace {

int take(int& from) {
  from = 5;
  return 1;
}

int sum(int a, int b) { return a + b; }

}  // namespace

class Orders {
 public:
  Orders() {
    operands_ = node_.advertise<std_msgs::Int32>("operands", 1);
    arguments_ = node_.advertise<std_msgs::Int32>("arguments", 1);
    nested_ = node_.advertise<std_msgs::Int32>("nested", 1);
    tick_ = node_.subscribe("tick", 1, &Orders::onTick, this);
  }

 private:
  void onTick(const std_msgs::Empty::ConstPtr&) {
    std_msgs::Int32 message;
    int n = 0;
    auto change = [&]() {
      n = 5;
      return 1;
    };
    message.data = n + change();
    operands_.publish(message);
    int m = 0;
    message.data = sum(m, take(m));
    arguments_.publish(message);
    level_ = 0;
    message.data = level();
    nested_.publish(message);
  }

  int raise() {
    level_ = 5;
    return 1;
  }

  int level() { return level_ + raise(); }

  ros::NodeHandle node_;
  ros::Publisher operands_, arguments_, nested_;
  ros::Subscriber tick_;
  int level_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "orders");
  Orders orders;
  ros::spin();
}
