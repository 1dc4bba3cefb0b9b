#include <ros/ros.h>
#include <std_msgs/Int32.h>

#include <memory>
#include <string>
#include <vector>

struct Lamp {
  ros::Publisher pub;
  void show(int x) {
    std_msgs::Int32 message;
    message.data = x;
    pub.publish(message);
  }
};

struct Keeper {
  ros::Publisher pub;
  explicit Keeper(ros::Publisher p) : pub(p) {}
};

class Meter {
  static int made_;
  int count_ = 1;
  int limit_ = 5;
  int& other_;
  int* kept_ = &limit_;
  const int& seen_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  std::vector<ros::Publisher> all_;
  std::shared_ptr<Lamp> lamp_;
  Keeper keeper_;

  void onTick(const std_msgs::Int32::ConstPtr& message) {
    other_ += message->data;
    made_++;
    *kept_ = 3;
    std_msgs::Int32 sum;
    sum.data = count_ + made_ + limit_;
    pub_.publish(sum);
    for (auto& pub : all_) pub.publish(sum);
    lamp_->show(made_);
  }

 public:
  explicit Meter(ros::NodeHandle& nh)
      : other_(count_), seen_(count_), lamp_(new Lamp), keeper_(pub_) {
    pub_ = nh.advertise<std_msgs::Int32>("sum", 5);
    sub_ = nh.subscribe("tick", 5, &Meter::onTick, this);
    lamp_->pub = nh.advertise<std_msgs::Int32>("lamp", 5);
    for (int i = 0; i < 3; i++) {
      all_.push_back(nh.advertise<std_msgs::Int32>("all" + std::to_string(i), 5));
    }
  }
};

int Meter::made_ = 4;

int main(int argc, char** argv) {
  ros::init(argc, argv, "meter");
  ros::NodeHandle nh;
  Meter meter(nh);
  ros::spin();
}
