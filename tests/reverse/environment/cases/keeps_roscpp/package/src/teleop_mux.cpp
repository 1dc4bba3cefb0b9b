// Hands on the joystick's commands while they are fresh, the planner's otherwise.
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

namespace teleop_mux {

class Mux {
 public:
  Mux() : private_nh_("~") {
    private_nh_.param("timeout", timeout_, 0.5);
    output_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 10);
    active_pub_ = nh_.advertise<std_msgs::String>("mux/active", 1, true);
    joy_sub_ = nh_.subscribe("joy_vel", 10, &Mux::joyCallback, this);
    nav_sub_ = nh_.subscribe("nav_vel", 10, &Mux::navCallback, this);
    timeout_timer_ =
        nh_.createTimer(ros::Duration(timeout_), &Mux::timeoutCallback, this, true, false);
    publish_timer_ = nh_.createTimer(ros::Duration(0.1), &Mux::publishCallback, this);
    announce("nav");
  }

 private:
  void joyCallback(const geometry_msgs::Twist::ConstPtr& msg) {
    last_joy_ = *msg;
    if (!joy_active_) {
      joy_active_ = true;
      ROS_INFO("joystick takes over");
      announce("joy");
    }
    timeout_timer_.stop();
    timeout_timer_.start();
  }

  void navCallback(const geometry_msgs::TwistConstPtr& msg) { last_nav_ = msg; }

  void timeoutCallback(const ros::TimerEvent&) {
    joy_active_ = false;
    announce("nav");
  }

  void publishCallback(const ros::TimerEvent&) {
    if (joy_active_) {
      output_.publish(last_joy_);
    } else if (last_nav_) {
      geometry_msgs::Twist out = *last_nav_;
      if (out.linear.x > 0.5) {
        out.linear.x = 0.5;
      }
      output_.publish(out);
    }
  }

  void announce(const std::string& name) {
    std_msgs::String active;
    active.data = name;
    active_pub_.publish(active);
  }

  ros::NodeHandle nh_;
  ros::NodeHandle private_nh_;
  ros::Publisher output_, active_pub_;
  ros::Subscriber joy_sub_, nav_sub_;
  ros::Timer timeout_timer_, publish_timer_;
  geometry_msgs::Twist last_joy_;
  geometry_msgs::TwistConstPtr last_nav_;
  double timeout_;
  bool joy_active_ = false;
};

}  // namespace teleop_mux

int main(int argc, char** argv) {
  ros::init(argc, argv, "teleop_mux");
  teleop_mux::Mux mux;
  ros::spin();
  return 0;
}
