// Two doors that publish whether they are open, and more of which nobody knows how many.
#include <vector>

#include <ros/ros.h>
#include <std_msgs/Bool.h>

class Door {
 public:
  Door() {
    open_ = node_.advertise<std_msgs::Bool>("open", 1);
    close_ = node_.subscribe("close", 1, &Door::onClose, this);
  }

 private:
  void onClose(const std_msgs::Bool& message) {
    std_msgs::Bool open;
    open.data = !message.data;
    open_.publish(open);
  }

  ros::NodeHandle node_;
  ros::Publisher open_;
  ros::Subscriber close_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "doors");
  Door door;
  std::vector<Door> more(3);
  ros::spin();
}
