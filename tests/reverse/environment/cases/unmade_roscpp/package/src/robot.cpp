#include <ros/ros.h>
#include <std_msgs/Int32.h>
class Watcher {
 public:
  Watcher() {
    pub_ = nh_.advertise<std_msgs::Int32>("alarm", 10);
    sub_ = nh_.subscribe("level", 10, &Watcher::cb, this);
  }
  void cb(const std_msgs::Int32::ConstPtr& msg) {
    std_msgs::Int32 m;
    m.data = 2;
    pub_.publish(m);
  }
 private:
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  ros::Publisher pub_;
};
class Robot {
 public:
  Robot() : w_(new Watcher()) {
    own_ = nh2_.advertise<std_msgs::Int32>("alarm", 10);
    sub2_ = nh2_.subscribe("go", 10, &Robot::go, this);
  }
 private:
  void go(const std_msgs::Int32::ConstPtr& msg) {
    std_msgs::Int32 m;
    m.data = 1;
    own_.publish(m);
  }
  ros::NodeHandle nh2_;
  ros::Publisher own_;
  ros::Subscriber sub2_;
  std::unique_ptr<Watcher> w_;
};
int main(int argc, char** argv) {
  ros::init(argc, argv, "robot");
  Robot robot;
  ros::spin();
}
