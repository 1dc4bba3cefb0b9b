// Members that hold functions: put there once, or more often.
#include <functional>
#include <ros/ros.h>

class Meter {
 public:
  Meter() {
    add_ = [this](int by) { sum_ += by; };
    bump_ = std::bind(&Meter::bump, this, std::placeholders::_1);
    done_ = std::bind(&Meter::finish, this);
    either_ = [this]() { sum_ = 1; };
    if (sum_ > 3) either_ = [this]() { sum_ = 2; };
    third_ = boost::bind(&Meter::bump, this, 3);
    timer_ = nh_.createTimer(ros::Duration(1.0), &Meter::look, this);
  }

 private:
  void look(const ros::TimerEvent&) {
    add_(2);
    bump_(sum_);
    if (sum_ > 40) done_();
    either_();
    third_();
  }
  void bump(int by) { sum_ = sum_ + by; }
  void finish() { sum_ = 0; }
  ros::NodeHandle nh_;
  ros::Timer timer_;
  std::function<void(int)> add_, bump_;
  std::function<void()> done_;
  std::function<void()> either_;
  boost::function<void()> third_;
  int sum_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "meter");
  Meter meter;
  ros::spin();
  return 0;
}
