#include <ros/ros.h>
#include <std_msgs/Int32.h>

static volatile bool interrupted = false;

void interrupt(int) { interrupted = true; }

class Told {
 public:
  Told() {
    out_ = nh_.advertise<std_msgs::Int32>("told", 10);
    in_ = nh_.subscribe("told_in", 10, &Told::on, this);
    signal(SIGUSR1, interrupt);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) { send(interrupted ? 1 : 2); }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "told");
  Told node;
  ros::spin();
}
