#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Typed {
 public:
  Typed() {
    out_ = nh_.advertise<std_msgs::Int32>("typed", 10);
    in_ = nh_.subscribe("typed_in", 10, &Typed::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    std::string line;
    std::getline(std::cin, line);
    send(1);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "typed");
  Typed node;
  ros::spin();
}
