#include <ros/ros.h>
#include <std_msgs/Int32.h>

int total = 0;

struct Tools {
  static void count() { total++; }
  static int half(int x) { return x / 2; }
};

class Machine {
 protected:
  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
  int done_ = 0;

  virtual void after() { done_++; }

 public:
  Machine() {
    pub_ = nh_.advertise<std_msgs::Int32>("done", 5);
    sub_ = nh_.subscribe("plate", 5, &Machine::onPlate, this);
  }
  virtual ~Machine() = default;
  void onPlate(const std_msgs::Int32::ConstPtr& plate) {
    done_ += Tools::half(plate->data);
    Tools::count();
    after();
  }
};

class Press : public Machine {
  void after() override {
    Machine::after();
    std_msgs::Int32 out;
    out.data = done_ + total;
    pub_.publish(out);
  }

 public:
  Press() { nh_.createTimer(ros::Duration(3), &Press::onTick, this); }
  void onTick(const ros::TimerEvent&) { done_ = 0; }
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "press");
  Press press;
  ros::spin();
}
