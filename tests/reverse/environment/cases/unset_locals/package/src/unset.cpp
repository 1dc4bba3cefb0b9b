#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Unset {
 public:
  Unset() {
    sometimes_ = node_.advertise<std_msgs::Bool>("sometimes", 1);
    always_ = node_.advertise<std_msgs::Bool>("always", 1);
    parameter_.param("inverted", inverted_, false);
    go_ = node_.subscribe("go", 1, &Unset::onGo, this);
  }

 private:
  void onGo(const std_msgs::Bool::ConstPtr& message) {
    bool sometimes, always;
    if (message->data) sometimes = false;
    if (message->data) {
      always = inverted_;
    } else {
      always = false;
    }
    std_msgs::Bool one, other;
    one.data = sometimes;
    other.data = always;
    sometimes_.publish(one);
    always_.publish(other);
  }

  ros::NodeHandle node_, parameter_{"~"};
  ros::Publisher sometimes_, always_;
  ros::Subscriber go_;
  bool inverted_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "unset");
  Unset unset;
  ros::spin();
}
