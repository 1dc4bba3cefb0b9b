#include <ros/ros.h>
#include <std_msgs/Int32.h>

#include <array>

struct Limits {
  int low;
  int high = 9;
};

class Gauge {
 public:
  explicit Gauge(int first) : listed_(first), braced_{}, empty_(), pair_{7} {
    in_ = nh_.subscribe("reading", 10, &Gauge::take, this);
    out_ = nh_.advertise<std_msgs::Int32>("reading", 10);
    timer_ = nh_.createTimer(ros::Duration(1.0), &Gauge::tick, this);
    assigned_ = first + 1;
    if (first > 3) {
      either_ = 1;
      sometimes_ = 1;
    } else {
      either_ = 2;
    }
    for (int i = 0; i < 3; i++) filled_[i] = i;
    for (int i = 0; i < 2; i++) partly_[i] = i;
    init();
    made_ = true;
  }

 private:
  void init() {
    called_ = 4;
    if (listed_ > 2) return;
    skipped_ = 5;
  }
  void take(const std_msgs::Int32& msg) {
    scratch_ = msg.data;
    total_ = scratch_ + listed_ + braced_ + empty_ + assigned_ + either_ + called_;
    total_ += sometimes_ + skipped_ + filled_[0] + partly_[0] + limits_.low + limits_.high;
    if (seen_ && made_) total_ = counter_;
    seen_ = true;
    counter_++;
    if (last_.data > 2 && (ros::Time::now() - since_).toSec() > 3) last_ = msg;
    since_ = ros::Time::now();
    rank_ = rank_ > 0 ? 0 : 1;
    table_[1] = table_[0];
    total_ += pair_[1] + given_[0] + grid_[1][0];
  }
  void tick(const ros::TimerEvent&) {
    std_msgs::Int32 m;
    m.data = total_ + files();
    out_.publish(m);
  }
  int files() {
    static int written;
    return ++written;
  }

  ros::NodeHandle nh_;
  ros::Subscriber in_;
  ros::Publisher out_;
  ros::Timer timer_;
  int listed_, braced_, empty_, assigned_;
  int either_, sometimes_, called_, skipped_, scratch_, total_;
  int filled_[3];
  int partly_[3];
  std::array<int, 2> table_, pair_;
  int given_[3] = {4, 5};
  double grid_[2][2] = {{1, 0.5}, {2}};
  Limits limits_;
  bool seen_, made_;
  int counter_;
  std_msgs::Int32 last_;
  ros::Time since_;
  int rank_;  // rebsync: domain 0..2
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "gauge");
  Gauge gauge(2);
  ros::spin();
  return 0;
}
