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

#include "experiment1_unsafe/r_1.h"

#include "experiment1_unsafe/R1State.h"

namespace experiment1_unsafe {

namespace {

constexpr Server kTaskControl{"taskControl", kNoPriority};
constexpr Server kMoveForward{"moveForward", kNoPriority};
constexpr Server kMoveBackward{"moveBackward", kNoPriority};
constexpr Server kWaitForCharge{"waitForCharge", kNoPriority};

}  // namespace

R_1::R_1(const ros::NodeHandle& node, int32_t fuel_capacity_initial, int32_t fuel_per_step_initial)
    : mailbox_(node, 4),
      drive_(node, mailbox_) {
  const ros::NodeHandle global;
  e11_ = global.param("e11", 2);
  e12_ = global.param("e12", 2);
  fuel_threshold_ = global.param("fuel_threshold", 15);
  chargeTime_ = global.param("chargeTime", 10);
  taskControl_sub_ = mailbox_.subscribe("taskControl", &R_1::receiveTaskControl, this);
  moveForward_sub_ = mailbox_.subscribe("moveForward", &R_1::receiveMoveForward, this);
  moveBackward_sub_ = mailbox_.subscribe("moveBackward", &R_1::receiveMoveBackward, this);
  waitForCharge_sub_ = mailbox_.subscribe("waitForCharge", &R_1::receiveWaitForCharge, this);
  state_pub_ = ros::NodeHandle(node).advertise<R1State>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(fuel_capacity_initial, fuel_per_step_initial); });
}

// rebsync: constructor R_1
void R_1::construct(int32_t fuel_capacity_initial, int32_t fuel_per_step_initial) {
  this->fuel_capacity_ = fuel_capacity_initial;
  this->fuel_per_step_ = fuel_per_step_initial;
  this->remaining_fuel_ = fuel_capacity_initial;
  this->moving_ = false;
  this->current_segment_ = 0;
  this->direct_moving_ = true;
  sendSelfTaskControl();
}

// rebsync: msgsrv R_1.taskControl
void R_1::taskControl() {
  if (this->remaining_fuel_ >= fuel_threshold_) {
    this->moving_ = true;
    if (this->direct_moving_ == true && this->current_segment_ < 10) {
      sendSelfMoveForward();
    } else if (this->direct_moving_ == true && this->current_segment_ == 10) {
      this->direct_moving_ = false;
      sendSelfMoveBackward();
    } else if (this->direct_moving_ == false && this->current_segment_ > 0) {
      sendSelfMoveBackward();
    } else if (this->direct_moving_ == false && this->current_segment_ == 0) {
      this->direct_moving_ = true;
      sendSelfMoveForward();
    }
  } else {
    this->moving_ = false;
    sendSelfWaitForCharge();
  }
}

// rebsync: msgsrv R_1.moveForward
void R_1::moveForward() {
  drive_.move(1, 0);
  mailbox_.delay(e11_);
  this->current_segment_ = this->current_segment_ + 1;
  this->remaining_fuel_ = this->remaining_fuel_ - this->fuel_per_step_;
  sendSelfTaskControl();
}

// rebsync: msgsrv R_1.moveBackward
void R_1::moveBackward() {
  drive_.move(-1, 0);
  mailbox_.delay(e12_);
  this->current_segment_ = this->current_segment_ - 1;
  this->remaining_fuel_ = this->remaining_fuel_ - this->fuel_per_step_;
  sendSelfTaskControl();
}

// rebsync: msgsrv R_1.waitForCharge
void R_1::waitForCharge() {
  mailbox_.delay(chargeTime_);
  this->remaining_fuel_ = this->fuel_capacity_;
  sendSelfTaskControl();
}

void R_1::receiveTaskControl(const R1TaskControl::ConstPtr& msg) {
  mailbox_.receive(kTaskControl, msg->timing, "", "", [this] { taskControl(); });
}

void R_1::receiveMoveForward(const R1MoveForward::ConstPtr& msg) {
  mailbox_.receive(kMoveForward, msg->timing, "", "", [this] { moveForward(); });
}

void R_1::receiveMoveBackward(const R1MoveBackward::ConstPtr& msg) {
  mailbox_.receive(kMoveBackward, msg->timing, "", "", [this] { moveBackward(); });
}

void R_1::receiveWaitForCharge(const R1WaitForCharge::ConstPtr& msg) {
  mailbox_.receive(kWaitForCharge, msg->timing, "", "", [this] { waitForCharge(); });
}

// rebsync: send R_1.self.taskControl
void R_1::sendSelfTaskControl(const When& when) {
  mailbox_.post(kTaskControl, when, "", [=] { taskControl(); });
}

// rebsync: send R_1.self.moveForward
void R_1::sendSelfMoveForward(const When& when) {
  mailbox_.post(kMoveForward, when, "", [=] { moveForward(); });
}

// rebsync: send R_1.self.moveBackward
void R_1::sendSelfMoveBackward(const When& when) {
  mailbox_.post(kMoveBackward, when, "", [=] { moveBackward(); });
}

// rebsync: send R_1.self.waitForCharge
void R_1::sendSelfWaitForCharge(const When& when) {
  mailbox_.post(kWaitForCharge, when, "", [=] { waitForCharge(); });
}

void R_1::publishState(const Served& served) {
  R1State msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  msg.fuel_capacity = fuel_capacity_;
  msg.fuel_per_step = fuel_per_step_;
  msg.remaining_fuel = remaining_fuel_;
  msg.moving = moving_;
  msg.current_segment = current_segment_;
  msg.direct_moving = direct_moving_;
  state_pub_.publish(msg);
}

}  // namespace experiment1_unsafe
