// Members: what the functions of a class leave in them.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <limits>

class Node {
 public:
  Node() : given_("made"), both_("made") {}
  void init(const std::string& name) {
    given_ = name;
    load();
    first_ = n_.advertise<std_msgs::Bool>(loaded_, shared_);  //= publisher {"loaded" = "unloaded"} "std_msgs/Bool" 6
  }
  void run() {
    n_.advertise<std_msgs::Bool>(given_, 1);  //= publisher "handed" "std_msgs/Bool" 1
    n_.advertise<std_msgs::Bool>(both_, 1);  //= publisher "chosen" | "made" "std_msgs/Bool" 1
    n_.advertise<std_msgs::Bool>(default_, options_.depth);  //= publisher "default" "std_msgs/Bool" 4
    n_.advertise<std_msgs::Bool>(heard_, 1);  //= publisher "unheard" "std_msgs/Bool" 1
    other_->pub_ = other_->n_.advertise<std_msgs::Bool>("other", 1);  //= publisher "~other" "std_msgs/Bool" 1
    n_.param("limit", limit_, std::numeric_limits<int>::max());  //= parameter get "limit" = 2147483647
  }
  void choose(bool sure) {
    if (sure) both_ = "chosen";
  }
  void heard(const std_msgs::Bool::ConstPtr& message) { heard_ = message->data ? "yes" : "no"; }

 private:
  struct Options {
    int depth = 4;
  };
  struct Other {
    Other() : n_("~") {}
    ros::NodeHandle n_;
    ros::Publisher pub_;
  };
  void load() {
    if (!n_.getParam("loaded", loaded_)) {  //= parameter get "loaded"
      loaded_ = "unloaded";
    }
  }
  static int shared_;
  ros::NodeHandle n_;
  ros::Publisher first_;
  std::string given_, both_, loaded_, default_ = "default", heard_ = "unheard";
  Options options_;
  Other* other_;
  int limit_;
};
int Node::shared_ = 6;

class Fixture : public testing::Test {
 protected:
  ros::NodeHandle n_{"fixture"};
};

TEST_F(Fixture, publishes) {
  n_.advertise<std_msgs::Bool>("x", 1);  //= publisher "fixture/x" "std_msgs/Bool" 1
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "members");  //= node "members"
  Node node;
  node.init("handed");
  node.choose(argc > 1);
  node.run();
}
