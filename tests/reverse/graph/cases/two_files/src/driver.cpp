#include "robot/driver.h"

#include <pluginlib/class_list_macros.h>

namespace robot {
Base::Base(ros::NodeHandle n, std::string prefix) : n_(n), prefix_(prefix) {
  n_.param("depth", depth_, depth_);  //= parameter get "~depth" = 5
}

Driver::Driver(ros::NodeHandle n) : Base(n), left_(*this, "left"), right_(*this, "right") {
  n_.getParam("frame", frame_);  //= parameter get "~frame" = "odom"
  sub_ = n_.subscribe(frame_, depth_, &Driver::imu, this);  //= subscription {"~frame" = "~odom"} "sensor_msgs/Imu" {"~depth" = 5} -> Driver::imu
}

void Driver::setUp(const std::string& name) {
  n_.advertise<std_msgs::Float64>(name, 1);  //= publisher "~base/set_up" "std_msgs/Float64" 1
}

Driver::Part::Part(Driver& driver, const std::string& name) {
  pub_ = driver.n_.advertise<std_msgs::Float64>(name, 2);  //= publisher "~left" | "~right" "std_msgs/Float64" 2
}

void Driver::imu(const sensor_msgs::Imu& message) {}

void Nodelet::onInit() {
  nh_ = getPrivateNodeHandle();
  driver_.reset(new Driver(nh_));
  driver_->start();
  timer_ = getMTNodeHandle().createTimer(ros::Duration(1), &Nodelet::tick, this);  //= timer 1.0 -> Nodelet::tick
  nh_.param<std::string>(getName() + "/x", name_, "y");  //= parameter get "~x" = "y"
}

void Nodelet::tick(const ros::TimerEvent& event) {}
}  // namespace robot

PLUGINLIB_EXPORT_CLASS(robot::Nodelet, nodelet::Nodelet)  //= node of Nodelet
PLUGINLIB_EXPORT_CLASS(robot::Driver, robot::Base)
