#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Bound {
 public:
  Bound() {
    out_ = nh_.advertise<std_msgs::Int32>("bound", 10);
    in_ = nh_.subscribe("bound_in", 10, &Bound::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void change(const int& value) {
    state_ = 9;
    send(value);
    state_ = 1;
  }

  void on(const std_msgs::Int32::ConstPtr& message) { change(state_); }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  int state_ = 1;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "bound");
  Bound node;
  ros::spin();
}
