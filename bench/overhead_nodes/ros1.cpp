// The ping-pong as one writes it by hand, with the messages of the generated package: a or b.
#include <ping/PingerPing.h>
#include <ping/PingerState.h>
#include <ping/PongerPong.h>
#include <ping/PongerState.h>
#include <ping/RefereeMark.h>
#include <ros/ros.h>

#include <string>

class Pinger {
 public:
  explicit Pinger(ros::NodeHandle& node)
      : pong_(node.advertise<ping::PongerPong>("b/pong", 1000)),
        mark_(node.advertise<ping::RefereeMark>("c/mark", 1000)),
        state_(node.advertise<ping::PingerState>("a/state", 1000, true)),
        subscriber_(node.subscribe("a/ping", 1000, &Pinger::receive, this,
            ros::TransportHints().tcpNoDelay())) {}

  void begin() {
    while (ros::ok() && pong_.getNumSubscribers() == 0) ros::WallDuration(0.05).sleep();
    ros::WallDuration(1.0).sleep();  // until the other hears, too
    serve();
  }

 private:
  void receive(const ping::PingerPing::ConstPtr&) { serve(); }

  void serve() {
    ++n_;
    if (n_ % 200 == 0) {
      ping::RefereeMark mark;
      mark.k = n_;
      mark_.publish(mark);
    }
    ping::PongerPong message;
    message.k = n_;
    pong_.publish(message);
    ping::PingerState state;
    state.server = "ping";
    state.n = n_;
    state_.publish(state);
  }

  int n_ = 0;
  ros::Publisher pong_, mark_, state_;
  ros::Subscriber subscriber_;
};

class Ponger {
 public:
  explicit Ponger(ros::NodeHandle& node)
      : ping_(node.advertise<ping::PingerPing>("a/ping", 1000)),
        state_(node.advertise<ping::PongerState>("b/state", 1000, true)),
        subscriber_(node.subscribe("b/pong", 1000, &Ponger::receive, this,
            ros::TransportHints().tcpNoDelay())) {}

 private:
  void receive(const ping::PongerPong::ConstPtr& message) {
    ping_.publish(ping::PingerPing());
    ping::PongerState state;
    state.server = "pong";
    state.arguments = std::to_string(message->k);
    state.n = message->k;
    state_.publish(state);
  }

  ros::Publisher ping_, state_;
  ros::Subscriber subscriber_;
};

int main(int argc, char** argv) {
  const std::string name = argv[1];
  ros::init(argc, argv, name);
  ros::NodeHandle node;
  if (name == "a") {
    Pinger pinger(node);
    pinger.begin();
    ros::spin();
  } else {
    Ponger ponger(node);
    ros::spin();
  }
  return 0;
}
