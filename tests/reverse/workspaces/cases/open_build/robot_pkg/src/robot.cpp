#include <ros/ros.h>
#include <base_pkg/base.hpp>
class Robot : public base_pkg::Base {
 public:
  explicit Robot(ros::NodeHandle& nh) : base_pkg::Base(nh) {}
 protected:
  void onLevel(int level) override { if (level > 3) { count_ = 1; send(1); } }
};
int main(int argc, char** argv) {
  ros::init(argc, argv, "robot");
  ros::NodeHandle nh;
  Robot robot(nh);
  ros::spin();
}
