// Default values that read what the constructors of classes above give.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Base {
 public:
  explicit Base(int level) : level_(level) { count_ = level + 1; }

 protected:
  int level_ = 1;
  int twice_ = level_ * 2;
  int count_ = 0;
};

template <typename T>
class Middle : public Base {
 public:
  explicit Middle(int level) : Base(level) {}

 protected:
  int middle_ = count_;
};

class Bases : public Middle<int> {
 public:
  Bases() : Middle<int>(6) {
    out_ = nh_.advertise<std_msgs::Int32>("bases", 10);
    sub_ = nh_.subscribe("ask", 10, &Bases::onAsk, this);
  }

 private:
  void onAsk(const std_msgs::Int32::ConstPtr&) {
    std_msgs::Int32 message;
    message.data = limit_;
    out_.publish(message);
  }
  int limit_ = level_ + twice_ + middle_;
  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber sub_;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "bases");
  Bases bases;
  ros::spin();
}
