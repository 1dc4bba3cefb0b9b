// Copyright 2026 The rebsync authors
//
// Licensed under the Apache License, Version 2.0 (the "License");
// you may not use this file except in compliance with the License.
// You may obtain a copy of the License at
//
//     http://www.apache.org/licenses/LICENSE-2.0
//
// Unless required by applicable law or agreed to in writing, software
// distributed under the License is distributed on an "AS IS" BASIS,
// WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
// See the License for the specific language governing permissions and
// limitations under the License.

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

  void sendSelfWalk(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t steps_{};  // rebsync: statevar Walker.steps

  ros::Subscriber walk_sub_;
  ros::Publisher state_pub_;
};

}  // namespace hello

#endif  // HELLO_WALKER_H
