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

#include "warehouse/dispatcher.h"

#include "warehouse/DispatcherState.h"

namespace warehouse {

namespace {

constexpr Server kLeft{"left", priority(1)};
constexpr Server kEnter{"enter", priority(2)};
constexpr Server kReady{"ready", priority(3)};

}  // namespace

Dispatcher::Dispatcher(const ros::NodeHandle& node, int32_t cell1, int32_t cell2, int32_t cell3,
    int32_t cell4)
    : mailbox_(node, 8, 1) {
  carrier1_ = node.param<std::string>("knownrebecs/carrier1", "");
  carrier2_ = node.param<std::string>("knownrebecs/carrier2", "");
  carrier3_ = node.param<std::string>("knownrebecs/carrier3", "");
  carrier4_ = node.param<std::string>("knownrebecs/carrier4", "");
  picker_serve_pub_ = mailbox_.advertise<LifterServe>("picker/serve");
  packer_serve_pub_ = mailbox_.advertise<LifterServe>("packer/serve");
  const ros::NodeHandle global;
  patience_ = global.param("patience", 4);
  Carrier_go_pubs_ = mailbox_.advertiseAll<CarrierGo>("Carrier", "go");
  left_sub_ = mailbox_.subscribeOnBridge("left", &Dispatcher::receiveLeft, this);
  enter_sub_ = mailbox_.subscribeOnBridge("enter", &Dispatcher::receiveEnter, this);
  ready_sub_ = mailbox_.subscribeOnBridge("ready", &Dispatcher::receiveReady, this);
  state_pub_ = ros::NodeHandle(node).advertise<DispatcherState>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(cell1, cell2, cell3, cell4); });
}

// rebsync: constructor Dispatcher
void Dispatcher::construct(int32_t cell1, int32_t cell2, int32_t cell3, int32_t cell4) {
  for (int32_t cell = 0; cell < 8; cell++) {
    holder_.at(cell) = 0;
    wanted_.at(cell) = false;
  }
  holder_.at(cell1) = 1;
  holder_.at(cell2) = 2;
  holder_.at(cell3) = 3;
  holder_.at(cell4) = 4;
}

// A carrier has left a cell for the next one. Reports go before requests.
// rebsync: msgsrv Dispatcher.left
// rebsync: annotation @priority(1)
void Dispatcher::left(int32_t cell) {
  mailbox_.assertion(holder_.at(cell) != 0, "a carrier leaves a cell that it does not hold");
  holder_.at(cell) = 0;
  if (wanted_.at(cell)) {
    Rebec<Carrier> carrier = carrierOf(holder_.at((cell + 7) % 8));
    wanted_.at(cell) = false;
    lend(carrier, cell, holder_.at((cell + 7) % 8));
  }
}

// A carrier asks for the cell before it.
// rebsync: msgsrv Dispatcher.enter
// rebsync: annotation @priority(2)
void Dispatcher::enter(int32_t id, int32_t cell) {
  if (holder_.at(cell) == 0) {
    lend(as<Carrier>(mailbox_.sender()), cell, id);
  } else {
    wanted_.at(cell) = true;
  }
}

// A carrier stands in the bay where it is to be loaded or unloaded.
// rebsync: msgsrv Dispatcher.ready
// rebsync: annotation @priority(3)
void Dispatcher::ready(int32_t cell) {
  Rebec<Carrier> carrier = as<Carrier>(mailbox_.sender());
  if (cell < 4) {
    sendPickerServe(carrier, cell, deadline(patience_));
  } else {
    sendPackerServe(carrier, 7 - cell, deadline(patience_));
  }
}

// rebsync: method Dispatcher.lend
void Dispatcher::lend(Rebec<Carrier> carrier, int32_t cell, int32_t id) {
  holder_.at(cell) = id;
  sendCarrierGoTo(carrier);
}

// rebsync: method Dispatcher.carrierOf
Rebec<Carrier> Dispatcher::carrierOf(int32_t id) {
  switch (id) {
    case 1: {
      return carrier1_;
    }
    case 2: {
      return carrier2_;
    }
    case 3: {
      return carrier3_;
    }
    default: {
      return carrier4_;
    }
  }
}

void Dispatcher::receiveLeft(const DispatcherLeft::ConstPtr& msg) {
  mailbox_.receive(kLeft, msg->timing, "", text(msg->cell), [this, msg] { left(msg->cell); });
}

void Dispatcher::receiveEnter(const DispatcherEnter::ConstPtr& msg) {
  mailbox_.receive(kEnter, msg->timing, msg->sender, text(msg->id, msg->cell),
      [this, msg] { enter(msg->id, msg->cell); });
}

void Dispatcher::receiveReady(const DispatcherReady::ConstPtr& msg) {
  mailbox_.receive(kReady, msg->timing, msg->sender, text(msg->cell),
      [this, msg] { ready(msg->cell); });
}

// rebsync: send Dispatcher.picker.serve
void Dispatcher::sendPickerServe(const Rebec<Carrier>& carrier, int32_t place, const When& when) {
  LifterServe msg;
  msg.carrier = carrier;
  msg.place = place;
  mailbox_.publish(picker_serve_pub_, msg, when);
}

// rebsync: send Dispatcher.packer.serve
void Dispatcher::sendPackerServe(const Rebec<Carrier>& carrier, int32_t place, const When& when) {
  LifterServe msg;
  msg.carrier = carrier;
  msg.place = place;
  mailbox_.publish(packer_serve_pub_, msg, when);
}

// rebsync: send Dispatcher.Carrier.go
void Dispatcher::sendCarrierGoTo(const std::string& recipient, const When& when) {
  CarrierGo msg;
  mailbox_.publish(to(Carrier_go_pubs_, recipient), msg, when);
}

void Dispatcher::publishState(const Served& served) {
  DispatcherState msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  flatten(holder_, msg.holder);
  flatten(wanted_, msg.wanted);
  state_pub_.publish(msg);
}

}  // namespace warehouse
