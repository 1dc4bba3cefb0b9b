#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Fine
{
public:
  Fine()
  {
    pub_ = nh_.advertise<std_msgs::Bool>("fine/out", 1);
    sub_ = nh_.subscribe("fine/in", 1, &Fine::onIn, this);
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
  ros::init(argc, argv, "fine");
  Fine node;
  ros::spin();
  return 0;
}
