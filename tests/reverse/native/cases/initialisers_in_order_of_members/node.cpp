#include <ros/ros.h>
#include <std_msgs/Int32.h>

class N {
 public:
  N() : second_(next()), first_(next()) {
    pub_ = nh_.advertise<std_msgs::Int32>("out", 9);
    sub_ = nh_.subscribe("inp", 9, &N::cb, this);
  }

  static int next() {
    static int last = 0;
    return ++last;
  }

  void cb(const std_msgs::Int32::ConstPtr& m) { put(second_); }

  void put(int value) {
    std_msgs::Int32 msg;
    msg.data = value;
    pub_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  int first_;
  int second_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  N n;
  ros::spin();
}
