#include <ros/ros.h>
#include <std_msgs/Int32.h>

static int limit(int value) { return value > 5 ? 5 : value; }

class Worker {
 public:
  Worker() { dishes_ = nh_.subscribe("dishes", 2, &Worker::work, this); }
  void work(const std_msgs::Int32::ConstPtr& dish) { carried_ = limit(carried_ + dish->data); }

 private:
  ros::NodeHandle nh_;
  ros::Subscriber dishes_;
  int carried_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "waiter");
  Worker worker;
  ros::spin();
}
