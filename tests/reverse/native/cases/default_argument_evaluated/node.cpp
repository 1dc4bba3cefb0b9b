#include <ros/ros.h>
#include <std_msgs/Int32.h>

int next() {
  static int last = 0;
  return last < 9 ? ++last : last;
}

class N {
 public:
  N() {
    pub_ = nh_.advertise<std_msgs::Int32>("out", 1);
    sub_ = nh_.subscribe("inp", 1, &N::cb, this);
  }
  int given(int v = next()) { return v; }

  void cb(const std_msgs::Int32::ConstPtr& m) {
    given();
    put(given());
  }

  void put(int value) {
    std_msgs::Int32 msg;
    msg.data = value;
    pub_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  N n;
  ros::spin();
}
