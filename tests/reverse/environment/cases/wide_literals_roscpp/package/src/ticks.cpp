// Counts ticks from a number that 32 bits do not hold.
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Int32.h>

class Ticks {
 public:
  Ticks() {
    seconds_ = node_.advertise<std_msgs::Int32>("seconds", 1);
    late_ = node_.advertise<std_msgs::Int32>("late", 1);
    tick_ = node_.subscribe("tick", 1, &Ticks::onTick, this);
  }

 private:
  void onTick(const std_msgs::Empty::ConstPtr&) {
    int64_t first = 4294967296;
    double seconds = first;
    std_msgs::Int32 message;
    message.data = seconds > 2.0 ? 1 : 2;
    seconds_.publish(message);
    message.data = first ? 1 : 2;
    late_.publish(message);
  }

  ros::NodeHandle node_;
  ros::Publisher seconds_, late_;
  ros::Subscriber tick_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "ticks");
  Ticks ticks;
  ros::spin();
}
