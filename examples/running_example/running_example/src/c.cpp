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

#include "running_example/c.h"

#include "running_example/CState.h"

namespace running_example {

namespace {

constexpr Server kCT1{"CT1", kNoPriority};
constexpr Server kCT2{"CT2", kNoPriority};
constexpr Server kCT3{"CT3", kNoPriority};

}  // namespace

C::C(const ros::NodeHandle& node, int32_t x1, int32_t y1, int32_t x2, int32_t y2)
    : mailbox_(node, 4) {
  robot1_P1_pub_ = mailbox_.advertise<R1P1>("robot1/P1");
  robot2_P2_pub_ = mailbox_.advertise<R2P2>("robot2/P2");
  const ros::NodeHandle global;
  ec1_ = global.param("ec1", 1);
  ec2_ = global.param("ec2", 1);
  ec3_ = global.param("ec3", 1);
  r1_goal_x_ = global.param("r1_goal_x", 4);
  r1_goal_y_ = global.param("r1_goal_y", 2);
  r2_goal_x_ = global.param("r2_goal_x", 2);
  r2_goal_y_ = global.param("r2_goal_y", 4);
  CT1_sub_ = mailbox_.subscribeOnBridge("CT1", &C::receiveCT1, this);
  CT2_sub_ = mailbox_.subscribeOnBridge("CT2", &C::receiveCT2, this);
  CT3_sub_ = mailbox_.subscribeOnBridge("CT3", &C::receiveCT3, this);
  state_pub_ = ros::NodeHandle(node).advertise<CState>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(x1, y1, x2, y2); });
}

// rebsync: constructor C
void C::construct(int32_t x1, int32_t y1, int32_t x2, int32_t y2) {
  pos1_[0] = x1;
  pos1_[1] = y1;
  pos2_[0] = x2;
  pos2_[1] = y2;
  moving_ = 0;
}

// A robot asks to enter the cell (x, y).
// rebsync: msgsrv C.CT1
void C::CT1(int32_t id, int32_t x, int32_t y) {
  mailbox_.delay(ec1_);
  if (moving_ == 0 && !occupied(id, x, y)) {
    moving_ = id;
    command(id, 1);
  } else {
    command(id, 0);
  }
}

// Decides whether a robot goes on, to the next cell on its way, or has come to its goal.
// rebsync: msgsrv C.CT2
void C::CT2(int32_t id) {
  mailbox_.delay(ec2_);
  if (id == 1 && !(pos1_[0] == r1_goal_x_ && pos1_[1] == r1_goal_y_)) {
    sendSelfCT1(id, pos1_[0] + 1, pos1_[1]);
  } else if (id == 2 && !(pos2_[0] == r2_goal_x_ && pos2_[1] == r2_goal_y_)) {
    sendSelfCT1(id, pos2_[0], pos2_[1] + 1);
  }
}

// A robot reports that it has done its task and where it is now.
// rebsync: msgsrv C.CT3
void C::CT3(int32_t id, int32_t x, int32_t y) {
  mailbox_.delay(ec3_);
  if (id == 1) {
    pos1_[0] = x;
    pos1_[1] = y;
  } else {
    pos2_[0] = x;
    pos2_[1] = y;
  }
  if (moving_ == id) {
    moving_ = 0;
  }
  sendSelfCT2(id);
}

// rebsync: method C.occupied
bool C::occupied(int32_t id, int32_t x, int32_t y) {
  if (id == 1) {
    return pos2_[0] == x && pos2_[1] == y;
  }
  return pos1_[0] == x && pos1_[1] == y;
}

// rebsync: method C.command
void C::command(int32_t id, int32_t cmd) {
  if (id == 1) {
    sendRobot1P1(cmd);
  } else {
    sendRobot2P2(cmd);
  }
}

void C::receiveCT1(const CCT1::ConstPtr& msg) {
  mailbox_.receive(kCT1, msg->timing, "", text(msg->id, msg->x, msg->y),
      [this, msg] { CT1(msg->id, msg->x, msg->y); });
}

void C::receiveCT2(const CCT2::ConstPtr& msg) {
  mailbox_.receive(kCT2, msg->timing, "", text(msg->id), [this, msg] { CT2(msg->id); });
}

void C::receiveCT3(const CCT3::ConstPtr& msg) {
  mailbox_.receive(kCT3, msg->timing, "", text(msg->id, msg->x, msg->y),
      [this, msg] { CT3(msg->id, msg->x, msg->y); });
}

// rebsync: send C.robot1.P1
void C::sendRobot1P1(int32_t cmd, const When& when) {
  R1P1 msg;
  msg.cmd = cmd;
  mailbox_.publish(robot1_P1_pub_, msg, when);
}

// rebsync: send C.robot2.P2
void C::sendRobot2P2(int32_t cmd, const When& when) {
  R2P2 msg;
  msg.cmd = cmd;
  mailbox_.publish(robot2_P2_pub_, msg, when);
}

// rebsync: send C.self.CT1
void C::sendSelfCT1(int32_t id, int32_t x, int32_t y, const When& when) {
  mailbox_.post(kCT1, when, text(id, x, y), [=] { CT1(id, x, y); });
}

// rebsync: send C.self.CT2
void C::sendSelfCT2(int32_t id, const When& when) {
  mailbox_.post(kCT2, when, text(id), [=] { CT2(id); });
}

void C::publishState(const Served& served) {
  CState msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  flatten(pos1_, msg.pos1);
  flatten(pos2_, msg.pos2);
  msg.moving = moving_;
  state_pub_.publish(msg);
}

}  // namespace running_example
