#include <optional>

#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Maybe {
 public:
  Maybe() {
    out_ = nh_.advertise<std_msgs::Int32>("maybe", 10);
    in_ = nh_.subscribe("maybe_in", 10, &Maybe::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    send(last_.value_or(1));
    last_ = message->data > 0 ? 5 : 6;
    if (message->data > 3) last_.reset();
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  std::optional<int> last_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "maybe");
  Maybe node;
  ros::spin();
}
