#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Runner {
 public:
  void listen() { sub_ = nh_.subscribe("signal", 1, &Runner::run, this); }
  void run(const std_msgs::Int32::ConstPtr& msg) { steps_ += msg->data; }

 private:
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  int steps_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "runner");
  Runner* runner = new Runner();
  runner->listen();
  ros::spin();
  delete runner;
}
