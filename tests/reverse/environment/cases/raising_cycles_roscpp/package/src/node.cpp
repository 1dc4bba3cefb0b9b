// Functions that call each other: what one raises leaves the other, too.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

#include <stdexcept>
#include <vector>

class Limited {
 public:
  Limited() {
    pub_ = n_.advertise<std_msgs::Int32>("out", 1);
    sub_ = n_.subscribe("in", 1, &Limited::in, this);
  }

 private:
  void in(const std_msgs::Int32::ConstPtr& message) {
    try {
      even(1);
    } catch (const std::out_of_range&) {
    }
    odd(7);
    level_ = 1;
    std_msgs::Int32 out;
    out.data = level_;
    pub_.publish(out);
  }

  static void even(int n) {
    std::vector<int> table{1, 2};
    table.at(n);
    odd(n - 1);
  }

  static void odd(int n) {
    if (n > 0) even(n - 1);
  }

  ros::NodeHandle n_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  int level_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "limited");
  Limited limited;
  ros::spin();
}
