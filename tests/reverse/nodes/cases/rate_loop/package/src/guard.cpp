#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Int16.h>

class Guard {
 public:
  explicit Guard(ros::NodeHandle handle) : handle_(handle), full_(8) {
    pub_ = handle_.advertise<std_msgs::Bool>("enable", 1);
    sub_ = handle_.subscribe<std_msgs::Int16>(
        "level", 1, [this](const std_msgs::Int16::ConstPtr& msg) { level_ = msg->data; });
  }
  void run() {
    ros::Rate rate(1);
    while (handle_.ok()) {
      std_msgs::Bool msg;
      msg.data = level_ < full_;
      pub_.publish(msg);
      rate.sleep();
      ros::spinOnce();
    }
  }

 private:
  ros::NodeHandle handle_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  int level_ = 0;
  const int full_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "guard");
  Guard guard(ros::NodeHandle("tank"));
  guard.run();
}
