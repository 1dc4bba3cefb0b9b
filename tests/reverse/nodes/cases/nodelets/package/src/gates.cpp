#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.h>
#include <ros/ros.h>
#include <std_msgs/UInt8.h>

namespace gates {

class Source : public nodelet::Nodelet {
  virtual void onInit() {
    ros::NodeHandle& nh = getNodeHandle();
    getPrivateNodeHandle().param("limit", limit_, 3);
    pub_ = nh.advertise<std_msgs::UInt8>("in", 4);
    timer_ = nh.createTimer(ros::Duration(1.0), &Source::fire, this);
  }
  void fire(const ros::TimerEvent&) {
    value_ = value_ < limit_ ? value_ + 1 : 0;
    std_msgs::UInt8Ptr out(new std_msgs::UInt8);
    out->data = value_;
    pub_.publish(out);
  }
  ros::Publisher pub_;
  ros::Timer timer_;
  int limit_;
  int value_ = 0;
};

class Gate : public nodelet::Nodelet {
  virtual void onInit() {
    sub_ = getNodeHandle().subscribe("in", 2, &Gate::pass, this);
    pub_ = getNodeHandle().advertise<std_msgs::UInt8>("out", 2);
  }
  void pass(const std_msgs::UInt8::ConstPtr& msg) {
    if (msg->data % 2 == 0) {
      return;
    }
    ++passed_;
    pub_.publish(msg);
  }
  ros::Subscriber sub_;
  ros::Publisher pub_;
  int passed_ = 0;
};

}  // namespace gates

PLUGINLIB_EXPORT_CLASS(gates::Source, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(gates::Gate, nodelet::Nodelet)
