// Publishers in maps and vectors: by keys in the code, and by others.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Switchboard {
 public:
  Switchboard() {
    sides_["left"] = nh_.advertise<std_msgs::Int32>("left", 10);
    this->sides_["right"] = nh_.advertise<std_msgs::Int32>("right", 10);
    lines_.push_back(nh_.advertise<std_msgs::Int32>("first", 10));
    lines_.push_back(nh_.advertise<std_msgs::Int32>("second", 10));
    pair_[1] = nh_.advertise<std_msgs::Int32>("last", 10);
    mixed_["a"] = nh_.advertise<std_msgs::Int32>("first", 10);
    mixed_["b"] = mixed_["a"];
    left_in_ = nh_.subscribe("left", 10, &Switchboard::left, this);
    right_in_ = nh_.subscribe("right", 10, &Switchboard::right, this);
    first_in_ = nh_.subscribe("first", 10, &Switchboard::first, this);
    second_in_ = nh_.subscribe("second", 10, &Switchboard::second, this);
    last_in_ = nh_.subscribe("last", 10, &Switchboard::last, this);
  }

 private:
  void left(const std_msgs::Int32::ConstPtr& msg) {
    sides_["right"].publish(msg);
    lines_[1].publish(*msg);
  }
  void right(const std_msgs::Int32::ConstPtr& msg) { lines_.at(0).publish(msg); }
  void first(const std_msgs::Int32::ConstPtr& msg) { pair_[1].publish(msg); }
  void second(const std_msgs::Int32::ConstPtr& msg) { mixed_["a"].publish(msg); }
  void last(const std_msgs::Int32::ConstPtr& msg) { lines_[msg->data].publish(msg); }
  ros::NodeHandle nh_;
  std::map<std::string, ros::Publisher> sides_, mixed_;
  std::vector<ros::Publisher> lines_;
  ros::Publisher pair_[2];
  ros::Subscriber left_in_, right_in_, first_in_, second_in_, last_in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "switchboard");
  Switchboard switchboard;
  ros::spin();
  return 0;
}
