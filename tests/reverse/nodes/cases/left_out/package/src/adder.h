#pragma once

#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Adder {
 public:
  static const int STEP = 4;
  Adder();

 private:
  void take(const std_msgs::Int32& msg);
  void add(int amount, int times = 2, bool wrap = false);
  int scaled(int value, int by = STEP * 2);
  void narrow(int value, uint8_t least = 300);
  void send(int value, const std_msgs::Int32& other = std_msgs::Int32());
  void at_limit(int value, int limit = rand());

  ros::NodeHandle nh_;
  ros::Subscriber in_;
  ros::Publisher out_;
  int total_ = 0;
};
