// Goes by words.
#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <std_msgs/String.h>

#define RESET "reset"
static const std::string START = "start";
constexpr const char* FINISH = "finish";

class Words {
 public:
  Words() {
    level_pub_ = nh_.advertise<std_msgs::Int32>("level", 1);
    status_pub_ = nh_.advertise<std_msgs::String>("status", 1);
    sub_ = nh_.subscribe("command", 1, &Words::callback, this);
  }

 private:
  void callback(const std_msgs::String::ConstPtr& msg) { onCommand(msg->data); }

  void onCommand(const std::string& word) {
    if (word.empty()) {
      enter("idle", 3);
    } else if (state_ == "idle" && word == START) {
      enter("running", 1);
    } else if (state_ == "running" && word.compare(FINISH) == 0) {
      enter("done", 2);
    } else if (word == RESET) {
      state_.clear();
      enter("idle", 0);
    }
  }

  void enter(const std::string& state, int level) {
    state_ = state;
    std_msgs::Int32 out;
    out.data = level;
    level_pub_.publish(out);
    std_msgs::String status;
    status.data = state_;
    status_pub_.publish(status);
  }

  ros::NodeHandle nh_;
  ros::Publisher level_pub_, status_pub_;
  ros::Subscriber sub_;
  std::string state_{"idle"};
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "words");
  Words words;
  ros::spin();
}
