#include <ros/ros.h>
#include <std_msgs/Int32.h>

namespace units {
double seconds(const ros::Time& time) { return time.toSec(); }
double seconds(const ros::Duration& time) { return time.toSec(); }
void fill(std::vector<double>& to, double by) { to.assign(3, by); }
void fill(double* to, double by) { *to = by; }
}  // namespace units

class Kept {
 public:
  virtual ~Kept() = default;
  virtual void clear() { cleared_ = cleared_ % 5 + 1; }
  virtual void clear(int to) { cleared_ = to; }

 protected:
  int cleared_ = 0;
};

class Sums : public Kept {
 public:
  Sums() {
    ros::NodeHandle node;
    numbers_ = node.subscribe("numbers", 4, &Sums::onNumber, this);
    sums_ = node.advertise<std_msgs::Int32>("sums", 4);
    echo_ = node.subscribe("sums", 4, &Sums::onSum, this);
  }

 private:
  void onNumber(const std_msgs::Int32::ConstPtr& msg) {
    add(msg->data);
    add(msg->data, 2);
    add(sum_, 1, true);
    clear();
    clear(cleared_ * 2);
    tell();
  }

  void clear() override { Kept::clear(); }
  void clear(int to) override { Kept::clear(to + 1); }

  void onSum(const std_msgs::Int32::ConstPtr& msg) {
    started_ = units::seconds(ros::Time::now());
    units::fill(seen_, 1.0);
    units::fill(&started_, units::seconds(ros::Duration(2.0)));
    either(msg->data);
    either(sum_);
  }

  void add(int number) { sum_ = sum_ % 100 + number % 7; }
  void add(int number, int times) { sum_ = sum_ % 100 + number % 7 * times; }
  void add(int number, int times, bool twice) {
    add(number, times);
    if (twice) add(number);
  }
  void either(int number) { sum_ = number; }
  void either(double number) { sum_ = 3; }
  void tell(bool loud = false) {
    std_msgs::Int32 sum;
    sum.data = sum_;
    sums_.publish(sum);
  }

  int sum_ = 0;
  double started_ = 0.0;
  std::vector<double> seen_;
  ros::Subscriber numbers_;
  ros::Subscriber echo_;
  ros::Publisher sums_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "sums");
  Sums sums;
  ros::spin();
  return 0;
}
