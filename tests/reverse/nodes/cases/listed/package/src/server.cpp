#include <actionlib/server/simple_action_server.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_srvs/Empty.h>

class Server {
 public:
  Server() : pub_(nh_.advertise<std_msgs::Bool>("state", 1)) {
    reset_ = nh_.advertiseService("reset", &Server::reset, this);
    sub_ = nh_.subscribe("state", 1, &Server::state, this);
    worker_ = std::thread([this] { state_ = !state_; });
    either_ = nh_.advertise<std_msgs::Bool>("state", 1);
    if (state_) {
      either_ = nh_.advertise<std_msgs::Bool>("other", 1);
    }
  }

 private:
  bool reset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
    state_ = false;
    return true;
  }
  void state(const std_msgs::Bool::ConstPtr& msg) {
    state_ = msg->data;
    either_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_, either_;
  ros::ServiceServer reset_;
  ros::Subscriber sub_;
  std::thread worker_;
  bool state_ = false;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "server");
  Server server;
  ros::topic::waitForMessage<std_msgs::Bool>("go");
  ros::AsyncSpinner spinner(4);
  spinner.start();
  ros::waitForShutdown();
}
