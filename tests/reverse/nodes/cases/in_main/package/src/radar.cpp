#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Radar {
 public:
  explicit Radar(int sectors) : sectors_(sectors) {}
  bool init(ros::NodeHandle& nh) {
    if (!nh.getParam("first", sector_)) {
      ROS_ERROR("no first sector");
      return false;
    }
    pub_ = nh.advertise<std_msgs::Bool>("contact", 1);
    return true;
  }
  void turn() { sector_ = (sector_ + 1) % sectors_; }
  void report(const ros::TimerEvent&) {
    std_msgs::Bool msg;
    msg.data = sector_ == 0;
    pub_.publish(msg);
  }

 private:
  ros::Publisher pub_;
  int sectors_;
  int sector_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "radar");
  ros::NodeHandle nh("~");
  Radar radar(6);
  if (!radar.init(nh)) {
    return 1;
  }
  ros::Timer timer = nh.createTimer(ros::Duration(4), &Radar::report, &radar);
  ros::Rate rate(1);
  while (ros::ok()) {
    radar.turn();
    ros::spinOnce();
    rate.sleep();
  }
}
