// Node handles: their namespaces, and how they come to where they are used.
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <memory>

ros::NodeHandle* everywhere;

class Member {
 public:
  Member() : private_("~"), inner_(private_, "inner") {
    a_ = plain_.advertise<std_msgs::String>("a", 1);  //= publisher "a" "std_msgs/String" 1
    b_ = private_.advertise<std_msgs::String>("b", 1);  //= publisher "~b" "std_msgs/String" 1
    c_ = inner_.advertise<std_msgs::String>("c", 1);  //= publisher "~inner/c" "std_msgs/String" 1
    d_ = this->inner_.advertise<std_msgs::String>("/d", 1);  //= publisher "/d" "std_msgs/String" 1
  }

 private:
  ros::NodeHandle plain_, private_, inner_;
  ros::Publisher a_, b_, c_, d_;
};

class Given {
 public:
  explicit Given(const ros::NodeHandle& handle) : handle_(handle), copy_(new ros::NodeHandle(handle)) {
    e_ = handle_.advertise<std_msgs::String>("e", 1);  //= publisher "~e" "std_msgs/String" 1
    f_ = copy_->advertise<std_msgs::String>("f", 1);  //= publisher "~f" "std_msgs/String" 1
  }

 private:
  ros::NodeHandle handle_;
  std::shared_ptr<ros::NodeHandle> copy_;
  ros::Publisher e_, f_;
};

// Made in two places.
struct Twice {
  Twice(ros::NodeHandle& handle, const std::string& name) {
    g_ = handle.advertise<std_msgs::String>(name + "/g", 1);  //= publisher "left/g" | "~right/g" "std_msgs/String" 1
  }
  ros::Publisher g_;
};

// Made in no file.
class Library {
 public:
  void start(ros::NodeHandle& handle) {
    ros::NodeHandle below(handle, "below");
    h_ = handle.advertise<std_msgs::String>("h", 1);  //= publisher .../h "std_msgs/String" 1
    i_ = below.advertise<std_msgs::String>("i", 1);  //= publisher .../below/i "std_msgs/String" 1
  }
  ros::Publisher h_, i_;
};

void useGlobal() {
  everywhere->advertise<std_msgs::String>("k", 1);  //= publisher "spread/k" "std_msgs/String" 1
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "handles");  //= node "handles"
  ros::NodeHandle node, own("~"), named("space"), absolute("/space");
  ros::NodeHandle copied(own);
  ros::NodeHandle deep(ros::NodeHandle(named, "a"), "b");
  auto* made = new ros::NodeHandle("~/sub");
  auto shared = std::make_shared<ros::NodeHandle>("shared");
  everywhere = new ros::NodeHandle("spread");
  node.advertise<std_msgs::String>("l", 1);  //= publisher "l" "std_msgs/String" 1
  named.advertise<std_msgs::String>("m", 1);  //= publisher "space/m" "std_msgs/String" 1
  absolute.advertise<std_msgs::String>("n", 1);  //= publisher "/space/n" "std_msgs/String" 1
  copied.advertise<std_msgs::String>("o", 1);  //= publisher "~o" "std_msgs/String" 1
  deep.advertise<std_msgs::String>("p", 1);  //= publisher "space/a/b/p" "std_msgs/String" 1
  made->advertise<std_msgs::String>("q", 1);  //= publisher "~sub/q" "std_msgs/String" 1
  shared->advertise<std_msgs::String>("r", 1);  //= publisher "shared/r" "std_msgs/String" 1
  (*made).advertise<std_msgs::String>("s", 1);  //= publisher "~sub/s" "std_msgs/String" 1
  ros::NodeHandle("t").advertise<std_msgs::String>("u", 1);  //= publisher "t/u" "std_msgs/String" 1
  Given given(own);
  Twice one(node, "left"), two(own, "right");
  ros::spin();
}
