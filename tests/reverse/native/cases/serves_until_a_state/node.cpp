#include <ros/ros.h>
#include <std_msgs/Int32.h>

class N {
 public:
  N() {
    pub_ = nh_.advertise<std_msgs::Int32>("out", 9);
    sub_ = nh_.subscribe("inp", 9, &N::cb, this);
  }

  void cb(const std_msgs::Int32::ConstPtr& m) { x_ += m->data; }

  void put(int value) {
    std_msgs::Int32 msg;
    msg.data = value;
    pub_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  int x_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  N n;
  ros::Rate rate(4);
  while (n.x_ < 2) {
    ros::spinOnce();
    rate.sleep();
  }
  n.put(n.x_ + 10);
}
