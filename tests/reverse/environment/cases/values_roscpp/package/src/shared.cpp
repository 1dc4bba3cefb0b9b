#include <atomic>

#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Shared {
 public:
  Shared() {
    out_ = nh_.advertise<std_msgs::Int32>("shared", 10);
    in_ = nh_.subscribe("shared_in", 10, &Shared::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    const int before = count_.fetch_add(1);
    if (before == 0) count_.store(254);
    send(before);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  std::atomic<uint8_t> count_{254};
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "shared");
  Shared node;
  ros::spin();
}
