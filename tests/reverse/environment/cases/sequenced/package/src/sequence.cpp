// Publishes what a function gets by value, and changes meanwhile.
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Int32.h>

class Sequence {
 public:
  Sequence() {
    sum_ = node_.advertise<std_msgs::Int32>("sum", 1);
    tick_ = node_.subscribe("tick", 1, &Sequence::onTick, this);
  }

 private:
  void onTick(const std_msgs::Empty::ConstPtr&) {
    int k = 5;
    auto half = [&](int of) {
      if (of > 2) {
        return of / 2;
      }
      return of;
    };
    auto behind = [&](int before) { return ++k * 10 + before; };
    std_msgs::Int32 message;
    message.data = half(k) * 100 + half(1);
    message.data += behind(k);
    sum_.publish(message);
  }

  ros::NodeHandle node_;
  ros::Publisher sum_;
  ros::Subscriber tick_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "sequence");
  Sequence sequence;
  ros::spin();
}
