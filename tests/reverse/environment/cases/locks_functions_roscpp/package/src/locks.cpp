#include <mutex>

#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Keeper {
 public:
  Keeper() {
    out_ = nh_.advertise<std_msgs::Bool>("done", 1);
    in_ = nh_.subscribe("go", 1, &Keeper::go, this);
  }

 private:
  void go(const std_msgs::Bool::ConstPtr& msg) {
    std::lock(mutex_, other_);
    std::lock_guard<std::mutex> again(mutex_);
    out_.publish(*msg);
  }
  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  std::mutex mutex_;
  std::mutex other_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "keeper");
  Keeper keeper;
  ros::spin();
}
