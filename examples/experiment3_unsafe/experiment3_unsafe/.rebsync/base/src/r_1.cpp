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

#include "experiment3_unsafe/r_1.h"

#include "experiment3_unsafe/R1State.h"
#include "experiment3_unsafe/r_1_sensors.h"

namespace experiment3_unsafe {

namespace {

constexpr Server kTaskControl{"taskControl", kNoPriority};
constexpr Server kMoveForward{"moveForward", kNoPriority};
constexpr Server kLidar{"lidar", kNoPriority};

}  // namespace

R_1::R_1(const ros::NodeHandle& node)
    : mailbox_(node, 4),
      drive_(node, mailbox_),
      lidar_sensor_(node, "sensor/lidar") {
  const ros::NodeHandle global;
  e11_ = global.param("e11", 2);
  sr11_ = global.param("sr11", 1);
  taskControl_sub_ = mailbox_.subscribe("taskControl", &R_1::receiveTaskControl, this);
  moveForward_sub_ = mailbox_.subscribe("moveForward", &R_1::receiveMoveForward, this);
  lidar_sub_ = mailbox_.subscribe("lidar", &R_1::receiveLidar, this);
  state_pub_ = ros::NodeHandle(node).advertise<R1State>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(); });
}

// rebsync: constructor R_1
void R_1::construct() {
  moving_ = false;
  current_segment_ = 0;
  obstacle_detected_ = false;
  sendSelfLidar();
  sendSelfTaskControl();
}

// rebsync: msgsrv R_1.taskControl
void R_1::taskControl() {
  if (current_segment_ < 10 && obstacle_detected_ == false) {
    moving_ = true;
    sendSelfMoveForward();
  } else if (obstacle_detected_ == true) {
    moving_ = false;
    sendSelfTaskControl(after(2));
  } else {
    moving_ = false;
  }
}

// rebsync: msgsrv R_1.moveForward
void R_1::moveForward() {
  drive_.move(1, 0);
  mailbox_.delay(e11_);
  current_segment_ = current_segment_ + 1;
  sendSelfTaskControl();
}

// rebsync: msgsrv R_1.lidar
// rebsync: annotation @Sensor
void R_1::lidar() {
  bool obstacle = mailbox_.choose({false, true}, lidar_sensor_.seen(&seenLidar));
  if (obstacle == true) {
    obstacle_detected_ = true;
  } else {
    obstacle_detected_ = false;
  }
  sendSelfLidar(after(sr11_));
}

void R_1::receiveTaskControl(const R1TaskControl::ConstPtr& msg) {
  mailbox_.receive(kTaskControl, msg->timing, "", "", [this] { taskControl(); });
}

void R_1::receiveMoveForward(const R1MoveForward::ConstPtr& msg) {
  mailbox_.receive(kMoveForward, msg->timing, "", "", [this] { moveForward(); });
}

void R_1::receiveLidar(const R1Lidar::ConstPtr& msg) {
  mailbox_.receive(kLidar, msg->timing, "", "", [this] { lidar(); });
}

// rebsync: send R_1.self.lidar
void R_1::sendSelfLidar(const When& when) {
  mailbox_.post(kLidar, when, "", [=] { lidar(); });
}

// rebsync: send R_1.self.taskControl
void R_1::sendSelfTaskControl(const When& when) {
  mailbox_.post(kTaskControl, when, "", [=] { taskControl(); });
}

// rebsync: send R_1.self.moveForward
void R_1::sendSelfMoveForward(const When& when) {
  mailbox_.post(kMoveForward, when, "", [=] { moveForward(); });
}

void R_1::publishState(const Served& served) {
  R1State msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  msg.moving = moving_;
  msg.current_segment = current_segment_;
  msg.obstacle_detected = obstacle_detected_;
  state_pub_.publish(msg);
}

}  // namespace experiment3_unsafe
