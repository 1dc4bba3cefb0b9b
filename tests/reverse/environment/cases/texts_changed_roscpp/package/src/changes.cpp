// Texts with which more is done than to copy and to compare them.
#include <boost/algorithm/string.hpp>
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/String.h>

class Changes {
 public:
  Changes() {
    others_ = nh_.advertise<std_msgs::Bool>("others", 1);
    appended_ = nh_.advertise<std_msgs::Bool>("appended", 1);
    indexed_ = nh_.advertise<std_msgs::Bool>("indexed", 1);
    pointed_ = nh_.advertise<std_msgs::Bool>("pointed", 1);
    lowered_ = nh_.advertise<std_msgs::Bool>("lowered", 1);
    reassigned_ = nh_.advertise<std_msgs::Bool>("reassigned", 1);
    moved_ = nh_.advertise<std_msgs::Bool>("moved", 1);
    sub_ = nh_.subscribe("command", 1, &Changes::onCommand, this);
  }

 private:
  void onCommand(const std_msgs::String::ConstPtr& msg) {
    std_msgs::Bool out;
    out.data = true;
    if (msg->data != "a" && last_ != "a" && msg->data != last_) {
      others_.publish(out);
    }
    first_ = msg->data;
    first_ += "p";
    if (first_ == "stop") {
      appended_.publish(out);
    }
    second_[0] = 's';
    if (second_ == "stop") {
      indexed_.publish(out);
    }
    std::string* pointer = &third_;
    pointer->replace(0, 1, "s");
    if (third_ == "stop") {
      pointed_.publish(out);
    }
    boost::algorithm::to_lower(fourth_);
    if (fourth_ == "stop") {
      lowered_.publish(out);
    }
    if (word_ == msg->data && msg->data == "stop") {
      reassigned_.publish(out);
    }
    std::string moved = std::move(fifth_);
    if (fifth_ != "stop") {
      moved_.publish(out);
    }
    last_ = msg->data;
    word_ = "stop";
  }

  ros::NodeHandle nh_;
  ros::Publisher others_, appended_, indexed_, pointed_, lowered_, reassigned_, moved_;
  ros::Subscriber sub_;
  std::string last_, first_, second_ = "xtop", third_ = "xtop", fourth_ = "STOP", fifth_ = "stop";
  const char* word_ = "go";
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "changes");
  Changes changes;
  ros::spin();
}
