#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Leaves {
 public:
  Leaves() {
    out_ = nh_.advertise<std_msgs::Int32>("leaves", 10);
    in_ = nh_.subscribe("leaves_in", 10, &Leaves::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    for (;;) {
      switch (message->data) {
        case 1:
          break;
      }
      if (message->data < 3) break;
      ROS_INFO("waiting");
    }
    send(1);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "leaves");
  Leaves node;
  ros::spin();
}
