#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Field {
 public:
  Field() {
    out_ = nh_.advertise<std_msgs::Int32>("field", 10);
    in_ = nh_.subscribe("field_in", 10, &Field::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void change(const int& value) {
    kept_.data = 5;
    send(value);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    kept_.data = 1;
    change(kept_.data);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  std_msgs::Int32 kept_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "field");
  Field node;
  ros::spin();
}
