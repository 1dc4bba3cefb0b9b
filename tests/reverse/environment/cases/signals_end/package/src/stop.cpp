#include <ros/ros.h>
#include <std_msgs/Int32.h>

void interrupt(int) { ros::shutdown(); }

class Stop {
 public:
  Stop() {
    out_ = nh_.advertise<std_msgs::Int32>("stop", 10);
    in_ = nh_.subscribe("stop_in", 10, &Stop::on, this);
    signal(SIGINT, interrupt);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) { send(1); }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "stop");
  Stop node;
  ros::spin();
}
