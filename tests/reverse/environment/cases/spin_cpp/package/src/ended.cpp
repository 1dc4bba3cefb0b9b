#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Ended
{
public:
  Ended()
  {
    pub_ = nh_.advertise<std_msgs::Bool>("ended/out", 1);
    sub_ = nh_.subscribe("ended/in", 1, &Ended::onIn, this);
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
  ros::init(argc, argv, "ended");
  {
    Ended node;
  }
  ros::spin();
  return 0;
}
