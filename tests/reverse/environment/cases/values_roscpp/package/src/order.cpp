#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Order {
 public:
  Order() {
    out_ = nh_.advertise<std_msgs::Int32>("order", 10);
    in_ = nh_.subscribe("order_in", 10, &Order::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    send(message->data < limit_ ? 1 : 2);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  unsigned limit_ = 3;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "order");
  Order node;
  ros::spin();
}
