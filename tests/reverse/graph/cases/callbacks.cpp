// What is called: functions, methods, binds, lambdas, functors, and the message types they tell.
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Bool.h>
#include <std_srvs/SetBool.h>
#include <boost/bind.hpp>

void plain(const std_msgs::Bool::ConstPtr& message) {}
void byValue(std_msgs::Bool message) {}
void byPointer(const std_msgs::BoolConstPtr& message) {}
void byEvent(const ros::MessageEvent<std_msgs::Bool const>& event) {}
void withMore(const std_msgs::Bool::ConstPtr& message, int number) {}
void lastOne(int number, const geometry_msgs::Twist& message) {}
bool serve(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) { return true; }

struct Functor {
  void operator()(const std_msgs::Bool::ConstPtr& message) { count_++; }
  int count_ = 0;
};

class Node {
 public:
  explicit Node(ros::NodeHandle& n) {
    n.subscribe("a", 1, &Node::method, this);  //= subscription "a" "sensor_msgs/LaserScan" 1 -> Node::method
    n.subscribe<sensor_msgs::LaserScan>("b", 1, boost::bind(&Node::method, this, _1));  //= subscription "b" "sensor_msgs/LaserScan" 1 -> Node::method
    n.subscribe<sensor_msgs::LaserScan>("c", 1, boost::bind(&Node::numbered, this, _1, 3));  //= subscription "c" "sensor_msgs/LaserScan" 1 -> Node::numbered with 1
    n.subscribe("d", 1, &Node::method, this, ros::TransportHints().tcpNoDelay());  //= subscription "d" "sensor_msgs/LaserScan" 1 -> Node::method
    n.subscribe<std_msgs::Bool>("e", 1, Forward(this));  //= subscription "e" "std_msgs/Bool" 1 -> Node::flagged by Node::Forward
    n.advertiseService("f", &Node::serve, this);  //= service "f" "std_srvs/SetBool" -> Node::serve
  }
  void method(const sensor_msgs::LaserScan::ConstPtr& scan) {}
  void numbered(const sensor_msgs::LaserScanConstPtr& scan, int number) {}
  void flagged(const std_msgs::BoolConstPtr& message) {}
  bool serve(std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) { return true; }

  class Forward {
   public:
    explicit Forward(Node* node) : node_(node) {}
    void operator()(const std_msgs::BoolConstPtr& message) { node_->flagged(message); }

   private:
    Node* node_;
  };
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "callbacks", ros::init_options::AnonymousName);  //= node "callbacks" anonymous
  ros::NodeHandle n;
  Functor functor;
  Node node(n);
  n.subscribe("g", 1, plain);  //= subscription "g" "std_msgs/Bool" 1 -> plain
  n.subscribe("h", 1, &byValue);  //= subscription "h" "std_msgs/Bool" 1 -> byValue
  n.subscribe("i", 1, byPointer);  //= subscription "i" "std_msgs/Bool" 1 -> byPointer
  n.subscribe("j", 1, byEvent);  //= subscription "j" "std_msgs/Bool" 1 -> byEvent
  n.subscribe<std_msgs::Bool>("k", 1, std::bind(withMore, std::placeholders::_1, 3));  //= subscription "k" "std_msgs/Bool" 1 -> withMore with 1
  n.subscribe<geometry_msgs::Twist>("l", 1, boost::bind(&lastOne, 3, _1));  //= subscription "l" "geometry_msgs/Twist" 1 -> lastOne with 1
  n.subscribe<std_msgs::Bool>("m", 1, functor);  //= subscription "m" "std_msgs/Bool" 1 -> Functor::operator() by Functor
  n.subscribe<std_msgs::Bool>("o", 1, [&](const std_msgs::BoolConstPtr& m) { functor(m); });  //= subscription "o" "std_msgs/Bool" 1 -> lambda
  auto later = [](const std_msgs::BoolConstPtr& m) {};
  n.subscribe<std_msgs::Bool>("p", 1, later);  //= subscription "p" "std_msgs/Bool" 1 -> lambda
  boost::function<void(const std_msgs::BoolConstPtr&)> kept = boost::bind(&Node::flagged, &node, _1);
  n.subscribe<std_msgs::Bool>("q", 1, kept);  //= subscription "q" "std_msgs/Bool" 1 -> Node::flagged
  void (*chosen)(const std_msgs::Bool::ConstPtr&) = argc > 1 ? &plain : &byPointer;
  n.subscribe("r", 1, chosen);  //= subscription "r" "std_msgs/Bool" 1 -> plain | byPointer
  n.subscribe("s", 1, &Node::method, &node);  //= subscription "s" "sensor_msgs/LaserScan" 1 -> Node::method
  n.advertiseService("t", serve);  //= service "t" "std_srvs/SetBool" -> serve
  n.serviceClient<std_srvs::SetBool>("u");  //= client "u" "std_srvs/SetBool"
  std_srvs::SetBool call;
  ros::service::call("v", call);  //= client "v" "std_srvs/SetBool"
  auto message = ros::topic::waitForMessage<std_msgs::Bool>("w", n);  //= subscription "w" "std_msgs/Bool" 1 single
  n.subscribe("x", 1, elsewhere);  //= subscription "x" ? 1 -> ?
}
