// Drives on until the bumper was pressed three times.
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Guard {
 public:
  Guard() {
    command_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    stopped_ = node_.advertise<std_msgs::Bool>("stopped", 1, true);
    bumper_ = node_.subscribe("bumper", 1, &Guard::onBumper, this);
    timer_ = node_.createTimer(ros::Duration(0.1), &Guard::drive, this);
  }

 private:
  void onBumper(const std_msgs::Bool::ConstPtr& message) {
    pressed_ = message->data;
    if (message->data && hits_ < 3) {
      ++hits_;
      if (hits_ == 3) {
        std_msgs::Bool stopped;
        stopped.data = true;
        stopped_.publish(stopped);
      }
    }
  }

  void drive(const ros::TimerEvent&) {
    geometry_msgs::Twist command;
    if (hits_ < 3 && !pressed_) {
      command.linear.x = 0.5;
    } else if (hits_ < 3) {
      command.angular.z = 1.0;
    }
    command_.publish(command);
  }

  ros::NodeHandle node_;
  ros::Publisher command_, stopped_;
  ros::Subscriber bumper_;
  ros::Timer timer_;
  int hits_ = 0;
  bool pressed_ = false;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "guard");
  Guard guard;
  ros::spin();
}
