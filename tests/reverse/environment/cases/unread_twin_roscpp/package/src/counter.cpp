// Counts what happens; the journal is here.
#include <ros/ros.h>
#include <std_msgs/Int32.h>

class Journal {
 public:
  virtual ~Journal() = default;
  virtual void write() = 0;
};

class File : public Journal {
 public:
  void write() override { ++lines_; }

 private:
  int lines_ = 0;
};

class Counter {
 public:
  explicit Counter(Journal& journal) : journal_(journal) {
    count_ = node_.advertise<std_msgs::Int32>("count", 1);
    timer_ = node_.createTimer(ros::Duration(1.0), &Counter::tick, this);
  }
  void count() { counted_ = 2; }

 private:
  void tick(const ros::TimerEvent&) {
    journal_.write();
    std_msgs::Int32 out;
    out.data = counted_;
    count_.publish(out);
  }

  Journal& journal_;
  ros::NodeHandle node_;
  ros::Publisher count_;
  ros::Timer timer_;
  int counted_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "counter");
  File file;
  Counter counter(file);
  ros::spin();
}
