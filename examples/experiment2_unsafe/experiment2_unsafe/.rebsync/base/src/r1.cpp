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

#include "experiment2_unsafe/r1.h"

#include "experiment2_unsafe/R1State.h"

namespace experiment2_unsafe {

namespace {

constexpr Server kBegin{"begin", kNoPriority};
constexpr Server kP1{"P1", kNoPriority};
constexpr Server kMoveInX{"MoveInX", kNoPriority};

}  // namespace

R1::R1(const ros::NodeHandle& node, int32_t robot_id, int32_t init_x, int32_t init_y)
    : mailbox_(node, 2),
      drive_(node, mailbox_) {
  controller_ControlTask_pub_ = mailbox_.advertise<ControlNodeControlTask>("controller/ControlTask");
  const ros::NodeHandle global;
  e1_ = global.param("e1", 1);
  begin_sub_ = mailbox_.subscribe("begin", &R1::receiveBegin, this);
  P1_sub_ = mailbox_.subscribe("port/P1", &R1::receiveP1, this);
  MoveInX_sub_ = mailbox_.subscribe("MoveInX", &R1::receiveMoveInX, this);
  state_pub_ = ros::NodeHandle(node).advertise<R1State>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(robot_id, init_x, init_y); });
}

// rebsync: constructor R1
void R1::construct(int32_t robot_id, int32_t init_x, int32_t init_y) {
  id_ = robot_id;
  stopped_ = true;
  pos_[0] = init_x;
  pos_[1] = init_y;
  // One after the other, so that the reports do not meet at the controller.
  sendSelfBegin(after(robot_id));
}

// rebsync: msgsrv R1.begin
void R1::begin() {
  sendControllerControlTask(id_, pos_[0], pos_[1]);
}

// Does what the controller commands: 0 stop at the goal, 1 move, 2 stop and ask again.
// rebsync: msgsrv R1.P1
// rebsync: annotation @Port
void R1::P1(int32_t cmd) {
  if (cmd == 0) {
    this->stopped_ = true;
  } else if (cmd == 1) {
    this->stopped_ = false;
    sendSelfMoveInX();
  } else if (cmd == 2) {
    this->stopped_ = true;
    sendControllerControlTask(id_, pos_[0], pos_[1], after(1));
  }
}

// rebsync: msgsrv R1.MoveInX
void R1::MoveInX() {
  drive_.move(1, 0);
  pos_[0] = pos_[0] + 1;
  mailbox_.delay(e1_);
  sendControllerControlTask(id_, pos_[0], pos_[1]);
}

void R1::receiveBegin(const R1Begin::ConstPtr& msg) {
  mailbox_.receive(kBegin, msg->timing, "", "", [this] { begin(); });
}

void R1::receiveP1(const R1P1::ConstPtr& msg) {
  mailbox_.receive(kP1, msg->timing, "", text(msg->cmd), [this, msg] { P1(msg->cmd); });
}

void R1::receiveMoveInX(const R1MoveInX::ConstPtr& msg) {
  mailbox_.receive(kMoveInX, msg->timing, "", "", [this] { MoveInX(); });
}

// rebsync: send R1.controller.ControlTask
void R1::sendControllerControlTask(int32_t sender_id, int32_t posX, int32_t posY, const When& when) {
  ControlNodeControlTask msg;
  msg.sender_id = sender_id;
  msg.pos_x = posX;
  msg.pos_y = posY;
  mailbox_.publish(controller_ControlTask_pub_, msg, when);
}

// rebsync: send R1.self.begin
void R1::sendSelfBegin(const When& when) {
  mailbox_.post(kBegin, when, "", [=] { begin(); });
}

// rebsync: send R1.self.MoveInX
void R1::sendSelfMoveInX(const When& when) {
  mailbox_.post(kMoveInX, when, "", [=] { MoveInX(); });
}

void R1::publishState(const Served& served) {
  R1State msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  msg.id = id_;
  msg.stopped = stopped_;
  flatten(pos_, msg.pos);
  state_pub_.publish(msg);
}

}  // namespace experiment2_unsafe
