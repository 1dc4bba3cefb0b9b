// An array of which each element would be a statement of the model, and one that is short enough.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

int cells[1500] = {0};
int corners[4] = {1, 2};

class Mapper {
 public:
  Mapper() { sub_ = nh_.subscribe("at", 10, &Mapper::onAt, this); }

 private:
  void onAt(const std_msgs::Int32::ConstPtr& msg) {
    if (corners[1] == 2) {
      cells[7] = msg->data;
    }
    if (cells[7] == 3) {
      corners[3] = 5;
    }
  }

  ros::NodeHandle nh_;
  ros::Subscriber sub_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "mapper");
  Mapper mapper;
  ros::spin();
}
