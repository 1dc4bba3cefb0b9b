// Periods and frequencies.
#include <ros/ros.h>

class Node {
 public:
  Node() : nh_("~"), rate_(4) {
    nh_.param("rate", rate_, 20.0);  //= parameter get "~rate" = 20.0
    int whole = 8;
    nh_.getParam("whole", whole);  //= parameter get "~whole" = 8
    slow_ = 2 * period_;
    a_ = nh_.createTimer(ros::Duration(0.5), &Node::tick, this);  //= timer 0.5 -> Node::tick
    b_ = nh_.createTimer(ros::Duration(1.0 / rate_), &Node::tick, this);  //= timer {"~rate" = 0.05 : 1.0/value} -> Node::tick
    c_ = nh_.createTimer(ros::Rate(rate_), &Node::tick, this, true);  //= timer {"~rate" = 0.05 : 1/value} one_shot=true -> Node::tick
    d_ = nh_.createTimer(ros::Duration(slow_), boost::bind(&Node::tick, this, _1), false, false);  //= timer 0.5 autostart=false -> Node::tick
    e_ = nh_.createWallTimer(ros::WallDuration(1, 500000000), &Node::wall, this);  //= timer 1.5 wall -> Node::wall
    f_ = nh_.createTimer(ros::Duration(1 / whole), &Node::tick, this);  //= timer {"~whole" = 0.0 : 1/value} -> Node::tick
    g_ = nh_.createTimer(ros::Duration(2) * 3, [this](const ros::TimerEvent& e) { tick(e); });  //= timer 6.0 -> Node::tick
    ros::TimerOptions options;
    options.period = ros::Duration(9);
    options.callback = boost::bind(&Node::tick, this, _1);
    options.oneshot = true;
    h_ = nh_.createTimer(options);  //= timer 9.0 one_shot=true -> Node::tick
  }
  void tick(const ros::TimerEvent& event) {}
  void wall(const ros::WallTimerEvent& event) {}
  void run(ros::Rate wanted) {
    ros::Rate loop(rate_);  //= rate {"~rate" = 20.0}
    ros::WallRate other(7), another(1 / 0.25);  //= rate 7 wall //= rate 4.0 wall
    kept_ = ros::Rate(3);  //= rate 3
    while (ros::ok()) loop.sleep();
  }

 private:
  ros::NodeHandle nh_;
  double rate_, period_ = 0.25, slow_;
  ros::Timer a_, b_, c_, d_, f_, g_, h_;
  ros::WallTimer e_;
  ros::Rate kept_ = ros::Rate(1);  //= rate 1
};
