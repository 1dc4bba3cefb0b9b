#include <ros/ros.h>
#include <std_msgs/Int32.h>

class First {
 public:
  First() {
    out_ = nh_.advertise<std_msgs::Int32>("first", 10);
    in_ = nh_.subscribe("first_in", 10, &First::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    int found = 0;
    for (int i = 0; i < 5; i++) {
      switch (i) {
        case 2:
          break;
        default:
          continue;
      }
      found = i;
      break;
    }
    send(found);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "first");
  First node;
  ros::spin();
}
