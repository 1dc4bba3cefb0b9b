#include "base_pkg/base.hpp"

namespace base_pkg {

static ros::Publisher pub;
static void onLevel(const std_msgs::Int32::ConstPtr& msg) {
  std_msgs::Int32 m;
  m.data = 5;
  pub.publish(m);
}
static void makeOther() {
  static ros::NodeHandle nh;
  pub = nh.advertise<std_msgs::Int32>("alarm", 10);
  static ros::Subscriber sub = nh.subscribe("level", 10, onLevel);
}
static void prepare() { makeOther(); }
void startOther() { prepare(); }
void publishValue(ros::Publisher& pub, int value) {
  std_msgs::Int32 m;
  m.data = value;
  pub.publish(m);
}

}  // namespace base_pkg
