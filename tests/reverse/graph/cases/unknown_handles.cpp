// Handles that come from outside of the files, with whatever type.
#include <ros/ros.h>
class Cam : public outside::Utils {
  void go(outside::Shared & shared) {
    ros::AdvertiseOptions ao = ros::AdvertiseOptions::create<sensor_msgs::Image>("image", 1, c, d, ros::VoidPtr(), &q);
    pub_ = this->rosnode_->advertise(ao);  //= publisher .../image "sensor_msgs/Image" 1
    pub2_ = rosnode_->advertise(ao);  //= publisher .../image "sensor_msgs/Image" 1
    auto nh = shared.handle();
    nh.advertise<std_msgs::Bool>("x", 1);  //= publisher .../x "std_msgs/Bool" 1
    nh.getParam("p", p_);  //= parameter get .../p
    shared.param("q", q_, 1.0);  //= parameter get .../q = 1.0
    shared.setParam("s", 2);  //= parameter set .../s := 2
    shared.hasParam("h");  //= parameter has .../h
    shared.setParam(1, 2);
    this->rosnode_->getParam("z", z_);  //= parameter get .../z
  }
};
