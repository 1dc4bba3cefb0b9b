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

#include "hello/walker.h"

#include "hello/WalkerState.h"

namespace hello {

namespace {

constexpr Server kWalk{"walk", kNoPriority};

}  // namespace

Walker::Walker(const ros::NodeHandle& node)
    : mailbox_(node, 2),
      drive_(node, mailbox_) {
  walk_sub_ = mailbox_.subscribe("walk", &Walker::receiveWalk, this);
  state_pub_ = ros::NodeHandle(node).advertise<WalkerState>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(); });
}

// rebsync: constructor Walker
void Walker::construct() {
  steps_ = 0;
  sendSelfWalk();
}

// rebsync: msgsrv Walker.walk
void Walker::walk() {
  drive_.move(1, 0);
  mailbox_.delay(2);
  steps_ = steps_ + 1;
  if (steps_ < 5) {
    sendSelfWalk(after(1));
  }
}

void Walker::receiveWalk(const WalkerWalk::ConstPtr& msg) {
  mailbox_.receive(kWalk, msg->timing, "", "", [this] { walk(); });
}

// rebsync: send Walker.self.walk
void Walker::sendSelfWalk(const When& when) {
  mailbox_.post(kWalk, when, "", [=] { walk(); });
}

void Walker::publishState(const Served& served) {
  WalkerState msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  msg.steps = steps_;
  state_pub_.publish(msg);
}

}  // namespace hello
