#include <ros/ros.h>
#include <std_msgs/Int32.h>

class N {
 public:
  N() {
    pub_ = nh_.advertise<std_msgs::Int32>("out", 1);
    sub_ = nh_.subscribe("inp", 1, &N::cb, this);
  }

  void cb(const std_msgs::Int32::ConstPtr& m) {
    uint32_t left = 1;
    uint32_t right = 3;
    int64_t sum = 3;
    sum += left - right;
    if (sum > 5) put(7);
  }

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
  ros::spin();
}
