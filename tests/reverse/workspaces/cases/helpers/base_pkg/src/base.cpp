#include "base_pkg/base.hpp"

namespace base_pkg {

void publishValue(ros::Publisher& pub, int value) {
  std_msgs::Int32 m;
  m.data = value;
  pub.publish(m);
}

}  // namespace base_pkg
