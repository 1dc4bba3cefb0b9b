#include "speaker.h"

namespace voices {

static const int kStep = 2;

Speaker::Speaker() : private_nh_("~"), volume_(0) { init(); }

void Speaker::init() {
  double period;
  private_nh_.param("threshold", threshold_, 4);
  private_nh_.param("period", period, 1.0);
  pub_ = nh_.advertise<std_msgs::Int32>("speech", 1);
  timer_ = nh_.createTimer(ros::Duration(period), &Speaker::speak, this);
}

void Speaker::speak(const ros::TimerEvent&) {
  volume_ += kStep;
  if (isLoud()) {
    volume_ = 0;
  }
  std_msgs::Int32 msg;
  msg.data = volume_;
  pub_.publish(msg);
}

}  // namespace voices
