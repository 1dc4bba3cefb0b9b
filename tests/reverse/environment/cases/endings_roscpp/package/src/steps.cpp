#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Steps {
 public:
  Steps() {
    out_ = nh_.advertise<std_msgs::Int32>("steps", 10);
    in_ = nh_.subscribe("steps_in", 10, &Steps::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    int left = 3;
    while (true) {
      int step = left / 2;
      ROS_INFO("waiting");
      if (step-- < 3) break;
    }
    send(1);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "steps");
  Steps node;
  ros::spin();
}
