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

#include "warehouse/lifter.h"

#include "warehouse/LifterState.h"
#include "warehouse/lifter_sensors.h"

namespace warehouse {

namespace {

constexpr Server kServe{"serve", kNoPriority};
constexpr Server kWeigh{"weigh", priority(1)};

}  // namespace

Lifter::Lifter(const ros::NodeHandle& node, int32_t start)
    : mailbox_(node, 3, 1),
      drive_(node, mailbox_),
      weigh_sensor_(node, "sensor/weigh") {
  dispatcher_ = node.param<std::string>("knownrebecs/dispatcher", "");
  const ros::NodeHandle global;
  drive_time_ = global.param("drive_time", 2);
  lift_time_ = global.param("lift_time", 2);
  weigh_rate_ = global.param("weigh_rate", 2);
  Carrier_served_pubs_ = mailbox_.advertiseAll<CarrierServed>("Carrier", "served");
  serve_sub_ = mailbox_.subscribe("port/serve", &Lifter::receiveServe, this);
  weigh_sub_ = mailbox_.subscribe("weigh", &Lifter::receiveWeigh, this);
  state_pub_ = ros::NodeHandle(node).advertise<LifterState>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(start); });
}

// rebsync: constructor Lifter
void Lifter::construct(int32_t start) {
  x_ = start;
  heavy_ = false;
  sendSelfWeigh();
}

// Goes to the bay at `place` and lifts the box of the carrier that stands there.
// rebsync: msgsrv Lifter.serve
// rebsync: annotation @Port
void Lifter::serve(Rebec<Carrier> carrier, int32_t place) {
  if (x_ < place) {
    drive_.move(1, 0);
    mailbox_.delay(drive_time_);
  } else if (x_ > place) {
    drive_.move(-1, 0);
    mailbox_.delay(drive_time_);
  }
  x_ = place;
  mailbox_.delay(heavy_ ? 2 * lift_time_ : lift_time_);
  sendCarrierServedTo(carrier);
}

// The scales under the next box.
// rebsync: msgsrv Lifter.weigh
// rebsync: annotation @Sensor
// rebsync: annotation @priority(1)
void Lifter::weigh() {
  heavy_ = mailbox_.choose({false, true}, weigh_sensor_.seen(&seenWeigh));
  sendSelfWeigh(after(weigh_rate_));
}

void Lifter::receiveServe(const LifterServe::ConstPtr& msg) {
  mailbox_.receive(kServe, msg->timing, "", text(msg->carrier, msg->place),
      [this, msg] { serve(msg->carrier, msg->place); });
}

void Lifter::receiveWeigh(const LifterWeigh::ConstPtr& msg) {
  mailbox_.receive(kWeigh, msg->timing, "", "", [this] { weigh(); });
}

// rebsync: send Lifter.Carrier.served
void Lifter::sendCarrierServedTo(const std::string& recipient, const When& when) {
  CarrierServed msg;
  mailbox_.publish(to(Carrier_served_pubs_, recipient), msg, when);
}

// rebsync: send Lifter.self.weigh
void Lifter::sendSelfWeigh(const When& when) {
  mailbox_.post(kWeigh, when, "", [=] { weigh(); });
}

void Lifter::publishState(const Served& served) {
  LifterState msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  msg.x = x_;
  msg.heavy = heavy_;
  state_pub_.publish(msg);
}

}  // namespace warehouse
