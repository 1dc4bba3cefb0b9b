#pragma once
#include <ros/ros.h>
#include <std_msgs/Int32.h>

namespace base_pkg {

// Hears levels; what they mean is for classes below to say.
class Base {
 public:
  explicit Base(ros::NodeHandle& nh);
  virtual ~Base() = default;

 protected:
  virtual void onLevel(int level) = 0;
  void send(int value);
  int count_ = 0;

 private:
  void cb(const std_msgs::Int32::ConstPtr& msg);
  ros::Subscriber sub_;
  ros::Publisher pub_;
};

// A node of its own, which the program `demo` of this package runs.
class Other {
 public:
  explicit Other(ros::NodeHandle& nh);
  void cb(const std_msgs::Int32::ConstPtr& msg);

 private:
  ros::Subscriber sub_;
  ros::Publisher pub_;
};

}  // namespace base_pkg
