#include <ros/ros.h>
#include <std_msgs/Byte.h>

const double FREQUENCY = 10.0;

class Metronome {
 public:
  Metronome() {
    pub_ = nh_.advertise<std_msgs::Byte>("beat", 1);
    timer_ = nh_.createWallTimer(ros::WallDuration(1.0 / FREQUENCY), &Metronome::beat, this);
    slow_ = nh_.createTimer(ros::Duration(0.25), &Metronome::bar, this);
  }
  void beat(const ros::WallTimerEvent&) {
    std_msgs::Byte msg;
    msg.data = beat_;
    pub_.publish(msg);
    beat_ = beat_ == 3 ? 0 : beat_ + 1;
  }
  void bar(const ros::TimerEvent&) { bars_ = 1 - bars_; }

 private:
  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::WallTimer timer_;
  ros::Timer slow_;
  signed char beat_ = 0;
  short bars_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "metronome");
  Metronome metronome;
  ros::spin();
}
