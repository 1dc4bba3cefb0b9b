#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Waits {
 public:
  Waits() {
    out_ = nh_.advertise<std_msgs::Int32>("waits", 10);
    in_ = nh_.subscribe("waits_in", 10, &Waits::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    while (ros::ok() && !ready_) {
      ROS_INFO("waiting");
    }
    send(1);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  bool ready_ = false;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "waits");
  Waits node;
  ros::spin();
}
