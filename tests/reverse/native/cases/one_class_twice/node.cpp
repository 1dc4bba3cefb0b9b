#include <ros/ros.h>
#include <std_msgs/Int32.h>

class N {
 public:
  explicit N(int k) : k_(k) {
    pub_ = nh_.advertise<std_msgs::Int32>("out", 9);
    sub_ = nh_.subscribe(k > 1 ? "inp" : "other", 9, &N::cb, this);
  }

  void cb(const std_msgs::Int32::ConstPtr& m) {
    k_ += m->data;
    put(k_);
  }

  void put(int value) {
    std_msgs::Int32 msg;
    msg.data = value;
    pub_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  int k_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  N first(1);
  N second(11);
  ros::spin();
}
