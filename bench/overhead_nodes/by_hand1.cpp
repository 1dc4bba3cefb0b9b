// Ping-pong by hand: what the generated nodes do, and no more. The first argument is `a` or `b`.
#include <ping/PingerPing.h>
#include <ping/PingerState.h>
#include <ping/PongerPong.h>
#include <ping/PongerState.h>
#include <ros/ros.h>

#include <string>

int main(int argc, char** argv) {
  const bool first = std::string(argv[1]) == "a";
  ros::init(argc, argv, argv[1]);
  ros::NodeHandle node;
  const auto hints = ros::TransportHints().tcpNoDelay();
  int n = 0;
  if (first) {
    const ros::Publisher out = node.advertise<ping::PongerPong>("b/pong", 1000);
    const ros::Publisher state = node.advertise<ping::PingerState>("a/state", 1000, true);
    ping::PingerState told;
    told.server = "ping";
    const auto serve = [&] {
      ping::PongerPong message;
      message.k = told.n = ++n;
      out.publish(message);
      state.publish(told);
    };
    const boost::function<void(const ping::PingerPing::ConstPtr&)> receive =
        [&](const ping::PingerPing::ConstPtr&) { serve(); };
    const ros::Subscriber in = node.subscribe<ping::PingerPing>("a/ping", 1000, receive, {}, hints);
    while (ros::ok() && out.getNumSubscribers() == 0) ros::WallDuration(0.05).sleep();
    ros::WallDuration(0.5).sleep();  // until the other hears, too
    serve();
    ros::spin();
  } else {
    const ros::Publisher out = node.advertise<ping::PingerPing>("a/ping", 1000);
    const ros::Publisher state = node.advertise<ping::PongerState>("b/state", 1000, true);
    ping::PongerState told;
    told.server = "pong";
    const boost::function<void(const ping::PongerPong::ConstPtr&)> receive =
        [&](const ping::PongerPong::ConstPtr& message) {
          told.n = message->k;
          told.arguments = std::to_string(message->k);
          out.publish(ping::PingerPing());
          state.publish(told);
        };
    const ros::Subscriber in = node.subscribe<ping::PongerPong>("b/pong", 1000, receive, {}, hints);
    ros::spin();
  }
  return 0;
}
