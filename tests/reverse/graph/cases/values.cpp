// Names and numbers: literals, constants, enumerations, concatenation, branches, helpers.
#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <string>
#define QUEUE 12
#define TOPIC "defined"
#define DOUBLED (2 * QUEUE)

typedef std_msgs::Int32 Count;
using Message = Count;
using std_msgs::Int32;

const std::string PREFIX = "pre";
static const int DEPTHS[] = {1, 2};
constexpr int SMALL = 3;
enum Queue { NONE, SHORT, LONG = 40, LONGER };
enum class Size { HUGE_ONE = 1000 };
namespace topics {
const char* const STATUS = "status";
static std::string moving = "moving";
}

struct Defaults {
  static const int LIMIT = 7;
  std::string topic = "from_struct";
  int depth{9};
};

std::string topicOf(const std::string& name, bool raw) {
  if (raw) {
    return name + "/raw";
  }
  return name + "/cooked";
}

int main(int argc, char** argv) {
  std::string node_name("values");
  ros::init(argc, argv, node_name);  //= node "values"
  ros::NodeHandle n;
  n.advertise<Count>(TOPIC, QUEUE);  //= publisher "defined" "std_msgs/Int32" 12
  n.advertise<Message>("a" "b", DOUBLED);  //= publisher "ab" "std_msgs/Int32" 24
  n.advertise<Int32>(PREFIX + "/x", SMALL);  //= publisher "pre/x" "std_msgs/Int32" 3
  n.advertise<Int32>(topics::STATUS, LONG);  //= publisher "status" "std_msgs/Int32" 40
  n.advertise<Int32>(std::string("s") + "t", LONGER);  //= publisher "st" "std_msgs/Int32" 41
  n.advertise<Int32>(topics::moving.c_str(), static_cast<int>(Size::HUGE_ONE));  //= publisher "moving" "std_msgs/Int32" 1000
  n.advertise<Int32>(topicOf("t", true), Defaults::LIMIT);  //= publisher "t/raw" "std_msgs/Int32" 7
  n.advertise<Int32>(topicOf("t", argc > 1), 1 + 2 * 3);  //= publisher "t/raw" | "t/cooked" "std_msgs/Int32" 7
  n.advertise<Int32>(argc > 1 ? "yes" : "no", 7 / 2);  //= publisher "yes" | "no" "std_msgs/Int32" 3
  n.advertise<Int32>("n" + std::to_string(4), (int)2.9);  //= publisher "n4" "std_msgs/Int32" 2
  n.advertise<Int32>(argv[1], 0x10);  //= publisher ? "std_msgs/Int32" 16

  std::string topic = "first";
  n.advertise<Int32>(topic, 1);  //= publisher "first" "std_msgs/Int32" 1
  topic += "/more";
  n.advertise<Int32>(topic, 1);  //= publisher "first/more" "std_msgs/Int32" 1
  topic = "second";
  if (argc > 2) topic = "third";
  n.advertise<Int32>(topic, 1);  //= publisher "third" | "second" "std_msgs/Int32" 1
  if (argc > 3) {
    topic = "fourth";
  } else {
    n.advertise<Int32>(topic, 1);  //= publisher "third" | "second" "std_msgs/Int32" 1
    topic = "fifth";
    n.advertise<Int32>(topic, 1);  //= publisher "fifth" "std_msgs/Int32" 1
  }
  n.advertise<Int32>(topic, 1);  //= publisher "fifth" | "fourth" "std_msgs/Int32" 1
  if (argc > 4) {
    topic = "gone";
    return 1;
  }
  if (false) topic = "never";
  n.advertise<Int32>(topic, 1);  //= publisher "fifth" | "fourth" "std_msgs/Int32" 1
  for (int i = 0; i < 3; i++) {
    n.advertise<Int32>("robot_" + std::to_string(i) + "/pose", 1);  //= publisher ? "robot_*/pose" "std_msgs/Int32" 1
  }
  Defaults defaults;
  n.advertise<Int32>(defaults.topic, defaults.depth);  //= publisher "from_struct" "std_msgs/Int32" 9
  defaults.topic = "set";
  n.advertise<Int32>(defaults.topic, 1);  //= publisher "set" "std_msgs/Int32" 1
  std::cin >> topic;
  n.advertise<Int32>(topic, 1);  //= publisher ? "std_msgs/Int32" 1
}
