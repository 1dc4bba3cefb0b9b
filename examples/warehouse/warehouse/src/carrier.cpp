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

#include "warehouse/carrier.h"

#include "warehouse/CarrierState.h"

namespace warehouse {

namespace {

constexpr Server kBegin{"begin", kNoPriority};
constexpr Server kGo{"go", kNoPriority};
constexpr Server kDrive{"drive", kNoPriority};
constexpr Server kServed{"served", kNoPriority};

}  // namespace

Carrier::Carrier(const ros::NodeHandle& node, int32_t number, int32_t start, int32_t load_bay)
    : mailbox_(node, 2),
      drive_(node, mailbox_) {
  dispatcher_enter_pub_ = mailbox_.advertise<DispatcherEnter>("dispatcher/enter");
  dispatcher_left_pub_ = mailbox_.advertise<DispatcherLeft>("dispatcher/left");
  dispatcher_ready_pub_ = mailbox_.advertise<DispatcherReady>("dispatcher/ready");
  const ros::NodeHandle global;
  drive_time_ = global.param("drive_time", 2);
  begin_sub_ = mailbox_.subscribe("begin", &Carrier::receiveBegin, this);
  go_sub_ = mailbox_.subscribe("port/go", &Carrier::receiveGo, this);
  drive_sub_ = mailbox_.subscribe("drive", &Carrier::receiveDrive, this);
  served_sub_ = mailbox_.subscribe("served", &Carrier::receiveServed, this);
  state_pub_ = ros::NodeHandle(node).advertise<CarrierState>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(number, start, load_bay); });
}

// rebsync: constructor Carrier
void Carrier::construct(int32_t number, int32_t start, int32_t load_bay) {
  id_ = number;
  cell_ = start;
  bay_ = load_bay;
  loaded_ = false;
  sendSelfBegin();
}

// rebsync: msgsrv Carrier.begin
void Carrier::begin() {
  sendDispatcherEnter(id_, following(cell_));
}

// rebsync: msgsrv Carrier.go
// rebsync: annotation @Port
void Carrier::go() {
  sendSelfDrive();
}

// rebsync: msgsrv Carrier.drive
void Carrier::drive() {
  switch (cell_) {
    case 3: {
      drive_.move(0, 1);
      break;
    }
    case 7: {
      drive_.move(0, -1);
      break;
    }
    case 4:
    case 5:
    case 6: {
      drive_.move(-1, 0);
      break;
    }
    default: {
      drive_.move(1, 0);
    }
  }
  mailbox_.delay(drive_time_);
  sendDispatcherLeft(cell_);
  cell_ = following(cell_);
  if ((cell_ == bay_ && !loaded_) || (cell_ == bay_ + 4 && loaded_)) {
    sendDispatcherReady(cell_);
  } else {
    sendDispatcherEnter(id_, following(cell_));
  }
}

// A lifter has put a box on the carrier or has taken it off.
// rebsync: msgsrv Carrier.served
void Carrier::served() {
  loaded_ = !loaded_;
  sendDispatcherEnter(id_, following(cell_));
}

// rebsync: method Carrier.following
int32_t Carrier::following(int32_t place) {
  return (place + 1) % 8;
}

void Carrier::receiveBegin(const CarrierBegin::ConstPtr& msg) {
  mailbox_.receive(kBegin, msg->timing, "", "", [this] { begin(); });
}

void Carrier::receiveGo(const CarrierGo::ConstPtr& msg) {
  mailbox_.receive(kGo, msg->timing, "", "", [this] { go(); });
}

void Carrier::receiveDrive(const CarrierDrive::ConstPtr& msg) {
  mailbox_.receive(kDrive, msg->timing, "", "", [this] { drive(); });
}

void Carrier::receiveServed(const CarrierServed::ConstPtr& msg) {
  mailbox_.receive(kServed, msg->timing, "", "", [this] { served(); });
}

// rebsync: send Carrier.dispatcher.enter
void Carrier::sendDispatcherEnter(int32_t id, int32_t cell, const When& when) {
  DispatcherEnter msg;
  msg.id = id;
  msg.cell = cell;
  msg.sender = mailbox_.self();
  mailbox_.publish(dispatcher_enter_pub_, msg, when);
}

// rebsync: send Carrier.dispatcher.left
void Carrier::sendDispatcherLeft(int32_t cell, const When& when) {
  DispatcherLeft msg;
  msg.cell = cell;
  mailbox_.publish(dispatcher_left_pub_, msg, when);
}

// rebsync: send Carrier.dispatcher.ready
void Carrier::sendDispatcherReady(int32_t cell, const When& when) {
  DispatcherReady msg;
  msg.cell = cell;
  msg.sender = mailbox_.self();
  mailbox_.publish(dispatcher_ready_pub_, msg, when);
}

// rebsync: send Carrier.self.begin
void Carrier::sendSelfBegin(const When& when) {
  mailbox_.post(kBegin, when, "", [=] { begin(); });
}

// rebsync: send Carrier.self.drive
void Carrier::sendSelfDrive(const When& when) {
  mailbox_.post(kDrive, when, "", [=] { drive(); });
}

void Carrier::publishState(const Served& served) {
  CarrierState msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  msg.id = id_;
  msg.cell = cell_;
  msg.bay = bay_;
  msg.loaded = loaded_;
  state_pub_.publish(msg);
}

}  // namespace warehouse
