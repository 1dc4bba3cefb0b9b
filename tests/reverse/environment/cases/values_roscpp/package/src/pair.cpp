#include <utility>

#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Pair {
 public:
  Pair() {
    out_ = nh_.advertise<std_msgs::Int32>("pair", 10);
    in_ = nh_.subscribe("pair_in", 10, &Pair::on, this);
  }

 private:
  void send(int value) {
    std_msgs::Int32 out;
    out.data = value;
    out_.publish(out);
  }

  void on(const std_msgs::Int32::ConstPtr& message) {
    auto [a, b] = pair_;
    auto& [c, d] = pair_;
    c = 5;
    send(a * 100 + pair_.first * 10 + b);
  }

  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber in_;
  std::pair<int, int> pair_{1, 2};
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "pair");
  Pair node;
  ros::spin();
}
