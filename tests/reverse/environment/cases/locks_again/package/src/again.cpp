#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Again {
 public:
  Again() {
    out_ = nh_.advertise<std_msgs::Int32>("again", 10);
    in_ = nh_.subscribe("again_in", 10, &Again::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void inner() {
    std::lock_guard<std::mutex> lock(mutex_);
    send(1);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    std::lock_guard<std::mutex> lock(mutex_);
    inner();
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  std::mutex mutex_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "again");
  Again node;
  ros::spin();
}
