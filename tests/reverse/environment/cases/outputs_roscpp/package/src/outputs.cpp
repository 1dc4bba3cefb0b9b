// Functions that fill what pointers lead to, if they lead anywhere.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Outputs {
 public:
  Outputs() {
    level_ = node_.advertise<std_msgs::Int32>("level", 1);
    in_ = node_.subscribe("in", 1, &Outputs::onIn, this);
  }

 private:
  void clear(int* level) {
    if (level) {
      *level = 0;
    }
  }

  bool read(int from, int* level) {
    if (level == nullptr || from < 3) {
      return false;
    }
    *level = from;
    return true;
  }

  void fill(int level, std_msgs::Int32* message) {
    if (!message) {
      return;
    }
    message->data = level;
  }

  void onIn(const std_msgs::Int32::ConstPtr& in) {
    int level = 7;
    clear(&level);
    if (!read(in->data, &level)) {
      level = level == 0 ? 1 : -1;
    }
    std_msgs::Int32 message;
    fill(level, &message);
    level_.publish(message);
  }

  ros::NodeHandle node_;
  ros::Publisher level_;
  ros::Subscriber in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "outputs");
  Outputs outputs;
  ros::spin();
}
