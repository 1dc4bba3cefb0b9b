#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Lost
{
public:
  Lost()
  {
    pub_ = nh_.advertise<std_msgs::Bool>("a", 1);
    sub_ = nh_.subscribe("go", 1, &Lost::onGo, this);
    ros::Timer timer = nh_.createTimer(ros::Duration(1.0), &Lost::onTimer, this);
  }

private:
  void onGo(const std_msgs::Bool::ConstPtr& message)
  {
    go_ = message->data;
  }

  void onTimer(const ros::TimerEvent&)
  {
    std_msgs::Bool message;
    message.data = go_;
    pub_.publish(message);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  bool go_ = false;
};

int main(int argc, char** argv)
{
  ros::init(argc, argv, "lost");
  Lost lost;
  ros::spin();
  return 0;
}
