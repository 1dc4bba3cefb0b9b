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

// The reactive class Lifter of warehouse.rebeca: one ROS node for each of its rebecs.
#ifndef WAREHOUSE_LIFTER_H
#define WAREHOUSE_LIFTER_H

#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "warehouse/CarrierServed.h"
#include "warehouse/LifterServe.h"
#include "warehouse/LifterWeigh.h"
#include "warehouse/LifterWeighData.h"
#include "warehouse/drive.h"
#include "warehouse/mailbox.h"
#include "warehouse/sensor.h"

namespace warehouse {

class Carrier;
class Dispatcher;

// rebsync: annotation @Robot
// rebsync: reactiveclass Lifter
class Lifter {
 public:
  Lifter(const ros::NodeHandle& node, int32_t start);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct(int32_t start);

  void serve(Rebec<Carrier> carrier, int32_t place);
  void weigh();

  void receiveServe(const LifterServe::ConstPtr& msg);
  void receiveWeigh(const LifterWeigh::ConstPtr& msg);

  void sendCarrierServedTo(const std::string& recipient, const When& when = When());
  void sendSelfWeigh(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t x_{};                   // rebsync: statevar Lifter.x
  bool heavy_{};                  // rebsync: statevar Lifter.heavy
  Rebec<Dispatcher> dispatcher_;  // rebsync: knownrebec Lifter.dispatcher
  int32_t drive_time_{};          // rebsync: env drive_time
  int32_t lift_time_{};           // rebsync: env lift_time
  int32_t weigh_rate_{};          // rebsync: env weigh_rate

  Sensor<LifterWeighData> weigh_sensor_;
  Publishers Carrier_served_pubs_;
  ros::Subscriber serve_sub_;
  ros::Subscriber weigh_sub_;
  ros::Publisher state_pub_;
};

}  // namespace warehouse

#endif  // WAREHOUSE_LIFTER_H
