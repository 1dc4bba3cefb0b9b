#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Blinker {
 public:
  Blinker() : on_(false) {
    pub_ = nh_.advertise<std_msgs::Bool>("light", 1);
    warm_up_ = nh_.createTimer(ros::Duration(5), &Blinker::ready, this, true);
  }

 private:
  void ready(const ros::TimerEvent&) { blink_ = nh_.createTimer(ros::Duration(1), &Blinker::blink, this, true); }
  void blink(const ros::TimerEvent&) {
    on_ = !on_;
    std_msgs::Bool msg;
    msg.data = on_;
    pub_.publish(msg);
    blink_ = nh_.createTimer(ros::Duration(on_ ? 1 : 3), &Blinker::blink, this, true);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Timer warm_up_, blink_;
  bool on_;
};

class Eye {
 public:
  Eye() { sub_ = nh_.subscribe("light", 1, &Eye::see, this); }
  void see(std_msgs::Bool msg) { flashes_ += msg.data ? 1 : 0; if (flashes_ >= 3) flashes_ = 0; }

 private:
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  int flashes_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "room");
  Blinker blinker;
  Eye eye;
  ros::spin();
}
