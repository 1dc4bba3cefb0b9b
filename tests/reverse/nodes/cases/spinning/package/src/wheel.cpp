#include <array>
#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <wheels/base.h>

class Counter {
 public:
  explicit Counter(int step) : step_(step) {}

 protected:
  int step_;
};

class Wheel : public Counter, public wheels::Base {
 public:
  Wheel() : Wheel(2) {}
  explicit Wheel(int step) : Counter(step) {
    pub_ = nh_.advertise<std_msgs::Int32>("turns", 1);
    brake_ = nh_.subscribe("brake", 1, &Wheel::brake, this);
    slots_.fill(0);
  }
  void onPower(bool on) override { powered_ = on; }
  void spin() {
    ros::Rate rate(1);
    while (ros::ok() && powered_) {
      static int turns = 0;
      turns += step_;
      slots_[turns % 3] = turns;
      std_msgs::Int32 msg;
      msg.data = turns;
      pub_.publish(msg);
      ros::spinOnce();
      rate.sleep();
    }
  }

 private:
  void brake(const std_msgs::Int32::ConstPtr& msg) {
    switch (msg->data) {
      case 0:
        powered_ = false;
        break;
      case 1:
        step_ = step_ > 1 ? step_ - 1 : 1;
    }
  }

  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber brake_;
  std::array<int, 3> slots_;
  bool powered_ = true;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "wheel");
  Wheel wheel;
  wheel.spin();
  return 0;
}
