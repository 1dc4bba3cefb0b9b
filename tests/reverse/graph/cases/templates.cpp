// A class template under other names, one constructor of which leaves all to the other.
#include <memory>
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <string>
#include <vector>

template <typename T>
class Filter {
 public:
  Filter(ros::NodeHandle node, ros::NodeHandle own, std::string name) : node_(node), own_(own), name_(name) {}
  Filter(ros::NodeHandle node, ros::NodeHandle own) : Filter<T>::Filter(node, own, "by itself") {}

  void start() {
    own_.param("rate", rate_, 10.0);  //= parameter get "~rate" = 10.0
    pub_ = node_.advertise<std_msgs::Bool>("out", 1);  //= publisher "out" "std_msgs/Bool" 1
  }

 private:
  ros::NodeHandle node_;
  ros::NodeHandle own_;
  std::string name_;
  double rate_;
  ros::Publisher pub_;
};

struct Fast {};
struct Exact {};
typedef Filter<Fast> FastFilter;
using ExactFilter = Filter<Exact>;
using Again = ExactFilter;

class Tested : public Again {
 public:
  Tested() : Again(ros::NodeHandle(), ros::NodeHandle("~"), "tested") {}
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "templates");  //= node "templates"
  ros::NodeHandle node, own("~");
  FastFilter fast(node, own);
  auto exact = std::make_unique<ExactFilter>(node, own, "exact");
  fast.start();
  exact->start();
}
