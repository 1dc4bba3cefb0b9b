#include "base_pkg/base.hpp"

namespace base_pkg {

class Other {
 public:
  Other() {
    nh_ = new ros::NodeHandle();
    pub_ = nh_->advertise<std_msgs::Int32>("alarm", 10);
    std_msgs::Int32 m;
    m.data = 5;
    pub_.publish(m);
  }
  ros::NodeHandle* nh_;
  ros::Publisher pub_;
};
void startOther() {
  static Other other;
}
void publishValue(ros::Publisher& pub, int value) {
  std_msgs::Int32 m;
  m.data = value;
  pub.publish(m);
}

}  // namespace base_pkg
