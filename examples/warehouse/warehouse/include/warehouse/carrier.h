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

// The reactive class Carrier of warehouse.rebeca: one ROS node for each of its rebecs.
#ifndef WAREHOUSE_CARRIER_H
#define WAREHOUSE_CARRIER_H

#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "warehouse/CarrierBegin.h"
#include "warehouse/CarrierDrive.h"
#include "warehouse/CarrierGo.h"
#include "warehouse/CarrierServed.h"
#include "warehouse/DispatcherEnter.h"
#include "warehouse/DispatcherLeft.h"
#include "warehouse/DispatcherReady.h"
#include "warehouse/drive.h"
#include "warehouse/mailbox.h"

namespace warehouse {

// rebsync: annotation @Robot
// rebsync: reactiveclass Carrier
class Carrier {
 public:
  Carrier(const ros::NodeHandle& node, int32_t number, int32_t start, int32_t load_bay);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct(int32_t number, int32_t start, int32_t load_bay);

  void begin();
  void go();
  void drive();
  void served();

  int32_t following(int32_t place);

  void receiveBegin(const CarrierBegin::ConstPtr& msg);
  void receiveGo(const CarrierGo::ConstPtr& msg);
  void receiveDrive(const CarrierDrive::ConstPtr& msg);
  void receiveServed(const CarrierServed::ConstPtr& msg);

  void sendDispatcherEnter(int32_t id, int32_t cell, const When& when = When());
  void sendDispatcherLeft(int32_t cell, const When& when = When());
  void sendDispatcherReady(int32_t cell, const When& when = When());
  void sendSelfBegin(const When& when = When());
  void sendSelfDrive(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t id_{};          // rebsync: statevar Carrier.id
  int32_t cell_{};        // rebsync: statevar Carrier.cell
  int32_t bay_{};         // rebsync: statevar Carrier.bay
  bool loaded_{};         // rebsync: statevar Carrier.loaded
  int32_t drive_time_{};  // rebsync: env drive_time

  // rebsync: knownrebec Carrier.dispatcher
  ros::Publisher dispatcher_enter_pub_;
  ros::Publisher dispatcher_left_pub_;
  ros::Publisher dispatcher_ready_pub_;
  ros::Subscriber begin_sub_;
  ros::Subscriber go_sub_;
  ros::Subscriber drive_sub_;
  ros::Subscriber served_sub_;
  ros::Publisher state_pub_;
};

}  // namespace warehouse

#endif  // WAREHOUSE_CARRIER_H
