#include <moods/Mood.h>
#include <ros/ros.h>
#include <std_msgs/Int32.h>

const std::string kPrefix = "sa";
const std::string kSad = kPrefix + "d";

class Moods {
 public:
  Moods() {
    out_ = node_.advertise<std_msgs::Int32>("out", 1);
    in_ = node_.subscribe("mood", 1, &Moods::onMood, this);
  }

 private:
  void onMood(const moods::Mood::ConstPtr& message) {
    std_msgs::Int32 out;
    if (message->mood == moods::Mood::HAPPY) {
      out.data = 1;
    } else if (message->mood == moods::Mood::SAD) {
      out.data = 2;
    } else if (message->mood == "happy") {
      out.data = 3;
    } else if (message->mood == "sad") {
      out.data = 4;
    } else {
      out.data = message->mood == kSad ? 5 : 6;
    }
    out_.publish(out);
  }

  ros::NodeHandle node_;
  ros::Publisher out_;
  ros::Subscriber in_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "moods");
  Moods moods;
  ros::spin();
}
