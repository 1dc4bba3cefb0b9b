// Parameters: what is read, with which default, and names that come from them.
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <cmath>
#include <limits>

template <typename T>
T required(const ros::NodeHandle& n, const std::string& key) {
  T value;
  if (!n.getParam(key, value)) {  //= parameter get "~must/speed" | "~must/name"
    ROS_FATAL("%s is missing", key.c_str());
  }
  return value;
}

void fill(ros::NodeHandle& n, std::string& topic) {
  if (!n.getParam("filled", topic)) topic = "unfilled";  //= parameter get "~filled"
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "parameters");  //= node "parameters"
  ros::NodeHandle n, p("~");
  std::string topic, frame = "map", key;
  double speed = 1.5, odd;
  bool flag;
  p.param<std::string>("topic", topic, "default");  //= parameter get "~topic" = "default"
  n.subscribe<std_msgs::Empty>(topic, 1, [](const std_msgs::EmptyConstPtr& m) {});  //= subscription {"~topic" = "default"} "std_msgs/Empty" 1 -> lambda
  n.advertise<std_msgs::Empty>(topic + "/out", 1);  //= publisher {"~topic" = "default/out" : value + "/out"} "std_msgs/Empty" 1
  p.advertise<std_msgs::Empty>(topic, 1);  //= publisher {"~topic" = "~default"} "std_msgs/Empty" 1
  p.getParam("frame", frame);  //= parameter get "~frame" = "map"
  p.param("speed", speed, speed);  //= parameter get "~speed" = 1.5
  p.param("flag", flag, false);  //= parameter get "~flag" = false
  p.param("odd", odd, std::numeric_limits<double>::quiet_NaN());  //= parameter get "~odd"
  if (std::isnan(odd)) odd = 4.0;
  ros::Rate rate(odd);  //= rate {"~odd" = 4.0}
  auto given = p.param<int>("given", 3);  //= parameter get "~given" = 3
  n.advertise<std_msgs::Empty>("a", given);  //= publisher "a" "std_msgs/Empty" {"~given" = 3}
  required<double>(p, "must/speed");
  std::string name = required<std::string>(p, "must/name");
  n.advertise<std_msgs::Empty>(name, 1);  //= publisher {"~must/name"} "std_msgs/Empty" 1
  fill(p, topic);
  n.advertise<std_msgs::Empty>(topic, 1);  //= publisher {"~filled" = "unfilled"} "std_msgs/Empty" 1
  ros::param::get("/global", topic);  //= parameter get "/global"
  ros::param::set("~set", 3 + 4);  //= parameter set "~set" := 7
  n.setParam("list", std::vector<int>(2, 5));  //= parameter set "list" := [5, 5]
  if (n.hasParam("here")) n.deleteParam("here");  //= parameter has "here" //= parameter delete "here"
  if (p.searchParam("up", key)) p.getParam(key, topic);  //= parameter search "~up" //= parameter search "~up"
  if (n.searchParam("level", key)) n.getParam(key, topic);  //= parameter search "level" //= parameter search ? "*/level"
  p.param(ros::this_node::getName() + "/own", topic, std::string("x"));  //= parameter get "~own" = "x"
  std::string space = ros::this_node::getName();
  n.param<int>(space + "/number", given, 0);  //= parameter get "~number" = 0
  ros::NodeHandle below(p, name);
  below.param("x", speed, 0.0);  //= parameter get {"~must/name" : value + "/x"} = 0.0
}
