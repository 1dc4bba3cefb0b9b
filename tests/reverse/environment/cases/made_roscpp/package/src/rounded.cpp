// Makes numbers of others, in parentheses.
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Int32.h>

class Rounded {
 public:
  Rounded() {
    sum_ = node_.advertise<std_msgs::Int32>("sum", 1);
    long_ = node_.advertise<std_msgs::Int32>("long", 1);
    tick_ = node_.subscribe("tick", 1, &Rounded::onTick, this);
  }

 private:
  void onTick(const std_msgs::Empty::ConstPtr&) {
    double half = 2.7;
    int whole(half);
    ros::Duration pause(half);
    int many = 260;
    uint8_t few(many);
    bool any(many);
    std_msgs::Int32 message;
    message.data = whole * 100 + few * 10 + any;
    if (pause.toSec() > 2.0) {
      long_.publish(message);
    }
    sum_.publish(message);
  }

  ros::NodeHandle node_;
  ros::Publisher sum_, long_;
  ros::Subscriber tick_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "rounded");
  Rounded rounded;
  ros::spin();
}
