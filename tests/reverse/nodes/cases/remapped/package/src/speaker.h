#ifndef SPEAKER_H
#define SPEAKER_H
#include <ros/ros.h>
#include <std_msgs/Int32.h>

#define SPEAKER_EXPORT

namespace voices {

class SPEAKER_EXPORT Speaker {
 public:
  Speaker();
  void init();

 private:
  void speak(const ros::TimerEvent& event);
  bool isLoud() const { return volume_ > threshold_; }

  ros::NodeHandle nh_, private_nh_;
  ros::Publisher pub_;
  ros::Timer timer_;
  int volume_;
  int threshold_ = 3;
};

}  // namespace voices
#endif
