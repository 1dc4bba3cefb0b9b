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

#include "running_example/r2.h"

#include "running_example/R2State.h"
#include "running_example/r2_sensors.h"

namespace running_example {

namespace {

constexpr Server kBegin{"begin", kNoPriority};
constexpr Server kP2{"P2", kNoPriority};
constexpr Server kA21{"A21", kNoPriority};
constexpr Server kS21{"S21", kNoPriority};

}  // namespace

R2::R2(const ros::NodeHandle& node, int32_t robot_id, int32_t init_x, int32_t init_y)
    : mailbox_(node, 3),
      drive_(node, mailbox_),
      S21_sensor_(node, "sensor/s21") {
  controller_CT3_pub_ = mailbox_.advertise<CCT3>("controller/CT3");
  controller_CT1_pub_ = mailbox_.advertise<CCT1>("controller/CT1");
  const ros::NodeHandle global;
  e21_ = global.param("e21", 2);
  sr21_ = global.param("sr21", 2);
  begin_sub_ = mailbox_.subscribe("begin", &R2::receiveBegin, this);
  P2_sub_ = mailbox_.subscribe("port/P2", &R2::receiveP2, this);
  A21_sub_ = mailbox_.subscribe("A21", &R2::receiveA21, this);
  S21_sub_ = mailbox_.subscribe("S21", &R2::receiveS21, this);
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
  data_ = 0;
  sendSelfS21();
  sendSelfBegin();
}

// rebsync: msgsrv R2.begin
void R2::begin() {
  sendControllerCT3(id_, pos_[0], pos_[1]);
}

// rebsync: msgsrv R2.P2
// rebsync: annotation @Port
void R2::P2(int32_t cmd) {
  if (cmd == 0) {
    // The robots may collide, so ask again after a time.
    stopped_ = true;
    sendControllerCT1(id_, pos_[0], pos_[1] + 1, after(1));
  } else if (data_ == 1) {
    // It is safe, but something is in the way: stay and say so.
    stopped_ = true;
    sendControllerCT3(id_, pos_[0], pos_[1], after(1));
  } else {
    stopped_ = false;
    sendSelfA21();
  }
}

// rebsync: msgsrv R2.A21
void R2::A21() {
  pos_[1] = pos_[1] + 1;
  stopped_ = false;
  drive_.move(0, 1);
  mailbox_.delay(e21_);
  stopped_ = true;
  sendControllerCT3(id_, pos_[0], pos_[1]);
}

// rebsync: msgsrv R2.S21
// rebsync: annotation @Sensor
void R2::S21() {
  data_ = mailbox_.choose({0, 1}, S21_sensor_.seen(&seenS21));
  sendSelfS21(after(sr21_));
}

void R2::receiveBegin(const R2Begin::ConstPtr& msg) {
  mailbox_.receive(kBegin, msg->timing, "", "", [this] { begin(); });
}

void R2::receiveP2(const R2P2::ConstPtr& msg) {
  mailbox_.receive(kP2, msg->timing, "", text(msg->cmd), [this, msg] { P2(msg->cmd); });
}

void R2::receiveA21(const R2A21::ConstPtr& msg) {
  mailbox_.receive(kA21, msg->timing, "", "", [this] { A21(); });
}

void R2::receiveS21(const R2S21::ConstPtr& msg) {
  mailbox_.receive(kS21, msg->timing, "", "", [this] { S21(); });
}

// rebsync: send R2.controller.CT3
void R2::sendControllerCT3(int32_t id, int32_t x, int32_t y, const When& when) {
  CCT3 msg;
  msg.id = id;
  msg.x = x;
  msg.y = y;
  mailbox_.publish(controller_CT3_pub_, msg, when);
}

// rebsync: send R2.controller.CT1
void R2::sendControllerCT1(int32_t id, int32_t x, int32_t y, const When& when) {
  CCT1 msg;
  msg.id = id;
  msg.x = x;
  msg.y = y;
  mailbox_.publish(controller_CT1_pub_, msg, when);
}

// rebsync: send R2.self.S21
void R2::sendSelfS21(const When& when) {
  mailbox_.post(kS21, when, "", [=] { S21(); });
}

// rebsync: send R2.self.begin
void R2::sendSelfBegin(const When& when) {
  mailbox_.post(kBegin, when, "", [=] { begin(); });
}

// rebsync: send R2.self.A21
void R2::sendSelfA21(const When& when) {
  mailbox_.post(kA21, when, "", [=] { A21(); });
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
  msg.data = data_;
  state_pub_.publish(msg);
}

}  // namespace running_example
