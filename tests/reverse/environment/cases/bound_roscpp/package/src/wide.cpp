#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Wide {
 public:
  Wide() {
    out_ = nh_.advertise<std_msgs::Int32>("wide", 10);
    in_ = nh_.subscribe("wide_in", 10, &Wide::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void change(const double& value) {
    state_ = 9;
    send(value > 5.0 ? 2 : 3);
    state_ = 1;
  }

  void on(const std_msgs::Int32::ConstPtr& message) { change(state_); }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  int state_ = 1;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "wide");
  Wide node;
  ros::spin();
}
