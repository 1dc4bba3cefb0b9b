#include <ros/ros.h>
#include <std_msgs/Int32.h>

enum class Level : uint8_t { low = 0, high = 255 };

class N {
 public:
  N() {
    pub_ = nh_.advertise<std_msgs::Int32>("out", 9);
    sub_ = nh_.subscribe("inp", 9, &N::cb, this);
  }

  void cb(const std_msgs::Int32::ConstPtr& m) {
    level_ = static_cast<Level>(m->data + 255);
    put(static_cast<int>(level_));
  }

  void put(int value) {
    std_msgs::Int32 msg;
    msg.data = value;
    pub_.publish(msg);
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  Level level_ = Level::low;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "n");
  N n;
  ros::spin();
}
