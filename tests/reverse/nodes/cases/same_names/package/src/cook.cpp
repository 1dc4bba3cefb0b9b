#include <ros/ros.h>
#include <std_msgs/Int32.h>

static int limit(int value) { return value > 9 ? 9 : value; }

class Worker {
 public:
  Worker() {
    dishes_ = nh_.advertise<std_msgs::Int32>("dishes", 2);
    timer_ = nh_.createTimer(ros::Duration(3), &Worker::work, this);
  }
  void work(const ros::TimerEvent&) {
    std_msgs::Int32 dish;
    dish.data = limit(++cooked_);
    dishes_.publish(dish);
  }

 private:
  ros::NodeHandle nh_;
  ros::Publisher dishes_;
  ros::Timer timer_;
  int cooked_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "cook");
  Worker worker;
  ros::spin();
}
