// The reactive class Walker of hello.rebeca: one ROS node for each of its rebecs.
#ifndef HELLO_WALKER_H
#define HELLO_WALKER_H

#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "hello/WalkerWalk.h"
#include "hello/drive.h"
#include "hello/mailbox.h"

namespace hello {

// rebsync: annotation @Robot
// rebsync: reactiveclass Walker
class Walker {
 public:
  explicit Walker(const ros::NodeHandle& node);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct();

  void walk();

  void receiveWalk(const WalkerWalk::ConstPtr& msg);

  void sendSelfWalk(const When& when_ = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t steps_{};  // rebsync: statevar Walker.steps

  ros::Subscriber walk_sub_;
  ros::Publisher state_pub_;
};

}  // namespace hello

#endif  // HELLO_WALKER_H
