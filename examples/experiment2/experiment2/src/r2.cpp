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

#include "experiment2/r2.h"

#include "experiment2/R2State.h"

namespace experiment2 {

namespace {

constexpr Server kBegin{"begin", kNoPriority};
constexpr Server kP2{"P2", kNoPriority};
constexpr Server kMoveInY{"MoveInY", kNoPriority};

}  // namespace

R2::R2(const ros::NodeHandle& node, int32_t robot_id, int32_t init_x, int32_t init_y)
    : mailbox_(node, 2),
      drive_(node, mailbox_) {
  controller_ControlTask_pub_ = mailbox_.advertise<ControlNodeControlTask>("controller/ControlTask");
  const ros::NodeHandle global;
  e2_ = global.param("e2", 1);
  begin_sub_ = mailbox_.subscribe("begin", &R2::receiveBegin, this);
  P2_sub_ = mailbox_.subscribe("port/P2", &R2::receiveP2, this);
  MoveInY_sub_ = mailbox_.subscribe("MoveInY", &R2::receiveMoveInY, this);
  state_pub_ = ros::NodeHandle(node).advertise<R2State>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(robot_id, init_x, init_y); });
}

// rebsync: constructor R2
void R2::construct(int32_t robot_id, int32_t init_x, int32_t init_y) {
  id_ = robot_id;
  stopped_ = true;
  pos_[0] = init_x;
  pos_[1] = init_y;
  sendSelfBegin(after(robot_id));
}

// rebsync: msgsrv R2.begin
void R2::begin() {
  sendControllerControlTask(id_, pos_[0], pos_[1]);
}

// rebsync: msgsrv R2.P2
// rebsync: annotation @Port
void R2::P2(int32_t cmd) {
  if (cmd == 0) {
    this->stopped_ = true;
  } else if (cmd == 1) {
    this->stopped_ = false;
    sendSelfMoveInY();
  } else if (cmd == 2) {
    this->stopped_ = true;
    sendControllerControlTask(id_, pos_[0], pos_[1], after(1));
  }
}

// rebsync: msgsrv R2.MoveInY
void R2::MoveInY() {
  drive_.move(0, 1);
  pos_[1] = pos_[1] + 1;
  mailbox_.delay(e2_);
  sendControllerControlTask(id_, pos_[0], pos_[1]);
}

void R2::receiveBegin(const R2Begin::ConstPtr& msg) {
  mailbox_.receive(kBegin, msg->timing, "", "", [this] { begin(); });
}

void R2::receiveP2(const R2P2::ConstPtr& msg) {
  mailbox_.receive(kP2, msg->timing, "", text(msg->cmd), [this, msg] { P2(msg->cmd); });
}

void R2::receiveMoveInY(const R2MoveInY::ConstPtr& msg) {
  mailbox_.receive(kMoveInY, msg->timing, "", "", [this] { MoveInY(); });
}

// rebsync: send R2.controller.ControlTask
void R2::sendControllerControlTask(int32_t sender_id, int32_t posX, int32_t posY, const When& when) {
  ControlNodeControlTask msg;
  msg.sender_id = sender_id;
  msg.pos_x = posX;
  msg.pos_y = posY;
  mailbox_.publish(controller_ControlTask_pub_, msg, when);
}

// rebsync: send R2.self.begin
void R2::sendSelfBegin(const When& when) {
  mailbox_.post(kBegin, when, "", [=] { begin(); });
}

// rebsync: send R2.self.MoveInY
void R2::sendSelfMoveInY(const When& when) {
  mailbox_.post(kMoveInY, when, "", [=] { MoveInY(); });
}

void R2::publishState(const Served& served) {
  R2State msg;
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

}  // namespace experiment2
