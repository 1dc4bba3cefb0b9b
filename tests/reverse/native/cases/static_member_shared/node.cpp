#include <ros/ros.h>
#include <std_msgs/Int32.h>

struct C {
  static int count;
  int inc() { return count < 9 ? ++count : count; }
};
int C::count = 0;

class N {
 public:
  N() {
    pub_ = nh_.advertise<std_msgs::Int32>("out", 1);
    sub_ = nh_.subscribe("inp", 1, &N::cb, this);
  }

  void cb(const std_msgs::Int32::ConstPtr& m) {
    a_.inc();
    put(b_.inc());
  }

  void put(int value) {
    std_msgs::Int32 msg;
    msg.data = value;
    pub_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  C a_;
  C b_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  N n;
  ros::spin();
}
