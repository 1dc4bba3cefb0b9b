#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Never
{
public:
  Never()
  {
    pub_ = nh_.advertise<std_msgs::Bool>("never/out", 1);
    sub_ = nh_.subscribe("never/in", 1, &Never::onIn, this);
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
  ros::init(argc, argv, "never");
  Never node;
  ros::Rate rate(10);
  while (ros::ok())
  {
    rate.sleep();
  }
  return 0;
}
