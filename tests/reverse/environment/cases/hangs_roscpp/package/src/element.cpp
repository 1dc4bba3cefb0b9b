#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Element {
 public:
  Element() {
    out_ = nh_.advertise<std_msgs::Int32>("element", 10);
    in_ = nh_.subscribe("element_in", 10, &Element::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void change(const int& value) {
    values_[index_] = 5;
    send(value);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    values_[index_] = 1;
    change(values_[index_]);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  int values_[2] = {0, 0};
  int index_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "element");
  Element node;
  ros::spin();
}
