#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Copy {
 public:
  Copy() {
    out_ = nh_.advertise<std_msgs::Int32>("copy", 10);
    in_ = nh_.subscribe("copy_in", 10, &Copy::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void change(const std_msgs::Int32 value) {
    kept_.data = 5;
    send(value.data);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    kept_.data = 1;
    change(kept_);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  std_msgs::Int32 kept_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "copy");
  Copy node;
  ros::spin();
}
