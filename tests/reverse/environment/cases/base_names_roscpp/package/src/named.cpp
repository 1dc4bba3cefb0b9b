// A base under another name: what its constructor gets is not read.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Level {
 public:
  explicit Level(int level) : level_(level) {}

 protected:
  int level_ = 1;
  int copy_ = level_;
};

class Named : public Level {
 public:
  using Base = Level;
  Named() : Base(6) {
    out_ = nh_.advertise<std_msgs::Int32>("named", 10);
    sub_ = nh_.subscribe("ask_named", 10, &Named::onAsk, this);
  }

 private:
  void onAsk(const std_msgs::Int32::ConstPtr&) {
    std_msgs::Int32 message;
    message.data = copy_;
    out_.publish(message);
  }
  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber sub_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "named");
  Named named;
  ros::spin();
}
