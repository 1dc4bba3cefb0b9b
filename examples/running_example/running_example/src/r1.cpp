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

#include "running_example/r1.h"

#include "running_example/R1State.h"
#include "running_example/r1_sensors.h"

namespace running_example {

namespace {

constexpr Server kBegin{"begin", kNoPriority};
constexpr Server kP1{"P1", kNoPriority};
constexpr Server kA11{"A11", kNoPriority};
constexpr Server kS11{"S11", kNoPriority};

}  // namespace

R1::R1(const ros::NodeHandle& node, int32_t robot_id, int32_t init_x, int32_t init_y)
    : mailbox_(node, 3),
      drive_(node, mailbox_),
      S11_sensor_(node, "sensor/s11") {
  controller_CT3_pub_ = mailbox_.advertise<CCT3>("controller/CT3");
  controller_CT1_pub_ = mailbox_.advertise<CCT1>("controller/CT1");
  const ros::NodeHandle global;
  e11_ = global.param("e11", 2);
  sr11_ = global.param("sr11", 2);
  begin_sub_ = mailbox_.subscribe("begin", &R1::receiveBegin, this);
  P1_sub_ = mailbox_.subscribe("port/P1", &R1::receiveP1, this);
  A11_sub_ = mailbox_.subscribe("A11", &R1::receiveA11, this);
  S11_sub_ = mailbox_.subscribe("S11", &R1::receiveS11, this);
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
  data_ = 0;
  sendSelfS11();
  sendSelfBegin();
}

// rebsync: msgsrv R1.begin
void R1::begin() {
  sendControllerCT3(id_, pos_[0], pos_[1]);
}

// rebsync: msgsrv R1.P1
// rebsync: annotation @Port
void R1::P1(int32_t cmd) {
  if (cmd == 0) {
    // The robots may collide, so ask again after a time.
    stopped_ = true;
    sendControllerCT1(id_, pos_[0] + 1, pos_[1], after(1));
  } else if (data_ == 1) {
    // It is safe, but something is in the way: stay and say so.
    stopped_ = true;
    sendControllerCT3(id_, pos_[0], pos_[1], after(1));
  } else {
    stopped_ = false;
    sendSelfA11();
  }
}

// rebsync: msgsrv R1.A11
void R1::A11() {
  pos_[0] = pos_[0] + 1;
  stopped_ = false;
  drive_.move(1, 0);
  mailbox_.delay(e11_);
  stopped_ = true;
  sendControllerCT3(id_, pos_[0], pos_[1]);
}

// rebsync: msgsrv R1.S11
// rebsync: annotation @Sensor
void R1::S11() {
  data_ = mailbox_.choose({0, 1}, S11_sensor_.seen(&seenS11));
  sendSelfS11(after(sr11_));
}

void R1::receiveBegin(const R1Begin::ConstPtr& msg) {
  mailbox_.receive(kBegin, msg->timing, "", "", [this] { begin(); });
}

void R1::receiveP1(const R1P1::ConstPtr& msg) {
  mailbox_.receive(kP1, msg->timing, "", text(msg->cmd), [this, msg] { P1(msg->cmd); });
}

void R1::receiveA11(const R1A11::ConstPtr& msg) {
  mailbox_.receive(kA11, msg->timing, "", "", [this] { A11(); });
}

void R1::receiveS11(const R1S11::ConstPtr& msg) {
  mailbox_.receive(kS11, msg->timing, "", "", [this] { S11(); });
}

// rebsync: send R1.controller.CT3
void R1::sendControllerCT3(int32_t id, int32_t x, int32_t y, const When& when) {
  CCT3 msg;
  msg.id = id;
  msg.x = x;
  msg.y = y;
  mailbox_.publish(controller_CT3_pub_, msg, when);
}

// rebsync: send R1.controller.CT1
void R1::sendControllerCT1(int32_t id, int32_t x, int32_t y, const When& when) {
  CCT1 msg;
  msg.id = id;
  msg.x = x;
  msg.y = y;
  mailbox_.publish(controller_CT1_pub_, msg, when);
}

// rebsync: send R1.self.S11
void R1::sendSelfS11(const When& when) {
  mailbox_.post(kS11, when, "", [=] { S11(); });
}

// rebsync: send R1.self.begin
void R1::sendSelfBegin(const When& when) {
  mailbox_.post(kBegin, when, "", [=] { begin(); });
}

// rebsync: send R1.self.A11
void R1::sendSelfA11(const When& when) {
  mailbox_.post(kA11, when, "", [=] { A11(); });
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
  msg.data = data_;
  state_pub_.publish(msg);
}

}  // namespace running_example
