#pragma once
#include <ros/ros.h>
#include <std_msgs/Int8.h>

class Behaviour {
 public:
  Behaviour() : active_(true), count_(0) {
    stop_ = nh_.subscribe("stop", 1, &Behaviour::onStop, this);
    timer_ = nh_.createTimer(ros::Duration(2), &Behaviour::onTimer, this);
  }
  virtual ~Behaviour() {}

 protected:
  virtual void step() = 0;
  void onStop(const std_msgs::Int8::ConstPtr& msg) {
    if (msg->data > 0) active_ = false;
  }
  void onTimer(const ros::TimerEvent&) {
    if (!active_) return;
    step();
  }

  ros::NodeHandle nh_;
  ros::Subscriber stop_;
  ros::Timer timer_;
  bool active_;
  int8_t count_;
};

class Patrol : public Behaviour {
 protected:
  void step() override { count_ = (count_ + 1) % 4; }
};

class Watch : public Behaviour {
 public:
  Watch() { pub_ = nh_.advertise<std_msgs::Int8>("stop", 1); }

 protected:
  void step() override {
    if (++count_ == 5) {
      std_msgs::Int8 msg;
      msg.data = count_;
      pub_.publish(msg);
    }
  }

 private:
  ros::Publisher pub_;
};
