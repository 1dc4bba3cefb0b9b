// The same of ROS 1, and what lets others change parameters.
#include <ros/ros.h>
#include <tf/transform_listener.h>

class Base {
  Base() : server_(nh_, "drive", false) {  //= Base action server  "drive" "demo/DriveAction"
    changed_ = new dynamic_reconfigure::Server<demo::BaseConfig>(nh_);  //= Base server changed_ "demo::BaseConfig"
  }
  ros::NodeHandle nh_;
  tf::TransformListener listener_;  //= Base listener listener_
  actionlib::SimpleActionServer<demo::DriveAction> server_;
  dynamic_reconfigure::Server<demo::BaseConfig> own_;  //= Base server own_ "demo::BaseConfig"
  boost::shared_ptr<dynamic_reconfigure::Server<demo::BaseConfig>> held_;
};

using namespace tf2_ros;

int main(int argc, char** argv) {
  TransformBroadcaster sent;  //= main broadcaster sent
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener heard(buffer);  //= main listener heard
  tf2_ros::TransformListener made();
}
