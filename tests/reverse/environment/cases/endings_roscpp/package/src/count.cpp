#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Count {
 public:
  Count() {
    out_ = nh_.advertise<std_msgs::Int32>("count", 10);
    in_ = nh_.subscribe("count_in", 10, &Count::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    for (int i = 0; i < 3; i++) {
      switch (message->data) {
        case 1:
          continue;
      }
      count_++;
    }
    send(count_);
    count_ = 0;
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  int count_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "count");
  Count node;
  ros::spin();
}
