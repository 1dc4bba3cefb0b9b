#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Blocked
{
public:
  Blocked()
  {
    pub_ = nh_.advertise<std_msgs::Bool>("blocked/out", 1);
    sub_ = nh_.subscribe("blocked/in", 1, &Blocked::onIn, this);
  }

private:
  void onIn(const std_msgs::Bool::ConstPtr& message)
  {
    std_msgs::Bool out;
    out.data = false;
    pub_.publish(out);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
};

int main(int argc, char** argv)
{
  ros::init(argc, argv, "blocked");
  Blocked node;
  ros::Rate rate(10);
  while (ros::ok())
  {
    rate.sleep();
  }
  while (ros::ok())
  {
    ros::spinOnce();
  }
  return 0;
}
