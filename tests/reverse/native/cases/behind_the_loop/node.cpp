#include <ros/ros.h>
#include <std_msgs/Int32.h>

class N {
 public:
  N() { pub_ = nh_.advertise<std_msgs::Int32>("out", 1); }

  void run() {
    ros::Rate rate(1);
    int n = 0;
    while (ros::ok() && n < 3) {
      put(n++);
      ros::spinOnce();
      rate.sleep();
    }
    put(100);
  }

  void put(int value) {
    std_msgs::Int32 msg;
    msg.data = value;
    pub_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  N n;
  n.run();
}
