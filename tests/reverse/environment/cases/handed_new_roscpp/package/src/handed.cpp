// Publishes messages by pointers, none of which it changes afterwards.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Handed {
 public:
  Handed() {
    mid_ = nh_.advertise<std_msgs::Int32>("mid", 10);
    out_ = nh_.advertise<std_msgs::Int32>("out", 10);
    cmd_ = nh_.subscribe("cmd", 10, &Handed::onCommand, this);
    back_ = nh_.subscribe("mid", 10, &Handed::onMid, this);
  }

 private:
  void onCommand(const std_msgs::Int32::ConstPtr&) {
    auto message = boost::make_shared<std_msgs::Int32>();
    message->data = 1;
    mid_.publish(message);
    std_msgs::Int32Ptr other(new std_msgs::Int32);
    other->data = 3;
    mid_.publish(other);
  }
  void onMid(const std_msgs::Int32::ConstPtr& message) { out_.publish(*message); }
  ros::NodeHandle nh_;
  ros::Publisher mid_, out_;
  ros::Subscriber cmd_, back_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "handed");
  Handed handed;
  ros::spin();
}
