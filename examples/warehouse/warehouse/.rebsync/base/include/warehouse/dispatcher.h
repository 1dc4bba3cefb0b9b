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

// The reactive class Dispatcher of warehouse.rebeca: one ROS node for each of its rebecs.
#ifndef WAREHOUSE_DISPATCHER_H
#define WAREHOUSE_DISPATCHER_H

#include <ros/ros.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "warehouse/CarrierGo.h"
#include "warehouse/DispatcherEnter.h"
#include "warehouse/DispatcherLeft.h"
#include "warehouse/DispatcherReady.h"
#include "warehouse/LifterServe.h"
#include "warehouse/mailbox.h"

namespace warehouse {

class Carrier;

// rebsync: annotation @Controller
// rebsync: reactiveclass Dispatcher
class Dispatcher {
 public:
  Dispatcher(const ros::NodeHandle& node, int32_t cell1, int32_t cell2, int32_t cell3,
      int32_t cell4);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct(int32_t cell1, int32_t cell2, int32_t cell3, int32_t cell4);

  void left(int32_t cell);
  void enter(int32_t id, int32_t cell);
  void ready(int32_t cell);

  void lend(Rebec<Carrier> carrier, int32_t cell, int32_t id);
  Rebec<Carrier> carrierOf(int32_t id);

  void receiveLeft(const DispatcherLeft::ConstPtr& msg);
  void receiveEnter(const DispatcherEnter::ConstPtr& msg);
  void receiveReady(const DispatcherReady::ConstPtr& msg);

  void sendPickerServe(const Rebec<Carrier>& carrier, int32_t place, const When& when = When());
  void sendPackerServe(const Rebec<Carrier>& carrier, int32_t place, const When& when = When());
  void sendCarrierGoTo(const std::string& recipient, const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;

  std::array<int32_t, 8> holder_{};  // rebsync: statevar Dispatcher.holder
  std::array<bool, 8> wanted_{};     // rebsync: statevar Dispatcher.wanted
  Rebec<Carrier> carrier1_;          // rebsync: knownrebec Dispatcher.carrier1
  Rebec<Carrier> carrier2_;          // rebsync: knownrebec Dispatcher.carrier2
  Rebec<Carrier> carrier3_;          // rebsync: knownrebec Dispatcher.carrier3
  Rebec<Carrier> carrier4_;          // rebsync: knownrebec Dispatcher.carrier4
  int32_t patience_{};               // rebsync: env patience

  // rebsync: knownrebec Dispatcher.picker
  ros::Publisher picker_serve_pub_;
  // rebsync: knownrebec Dispatcher.packer
  ros::Publisher packer_serve_pub_;
  Publishers Carrier_go_pubs_;
  ros::Subscriber left_sub_;
  ros::Subscriber enter_sub_;
  ros::Subscriber ready_sub_;
  ros::Publisher state_pub_;
};

}  // namespace warehouse

#endif  // WAREHOUSE_DISPATCHER_H
