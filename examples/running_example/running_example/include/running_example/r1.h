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

// The reactive class R1 of running_example.rebeca: one ROS node for each of its rebecs.
#ifndef RUNNING_EXAMPLE_R1_H
#define RUNNING_EXAMPLE_R1_H

#include <ros/ros.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "running_example/CCT1.h"
#include "running_example/CCT3.h"
#include "running_example/R1A11.h"
#include "running_example/R1Begin.h"
#include "running_example/R1P1.h"
#include "running_example/R1S11.h"
#include "running_example/R1S11Data.h"
#include "running_example/drive.h"
#include "running_example/mailbox.h"
#include "running_example/sensor.h"

namespace running_example {

// rebsync: annotation @Robot
// rebsync: reactiveclass R1
class R1 {
 public:
  R1(const ros::NodeHandle& node, int32_t robot_id, int32_t init_x, int32_t init_y);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct(int32_t robot_id, int32_t init_x, int32_t init_y);

  void begin();
  void P1(int32_t cmd);
  void A11();
  void S11();

  void receiveBegin(const R1Begin::ConstPtr& msg);
  void receiveP1(const R1P1::ConstPtr& msg);
  void receiveA11(const R1A11::ConstPtr& msg);
  void receiveS11(const R1S11::ConstPtr& msg);

  void sendControllerCT3(int32_t id, int32_t x, int32_t y, const When& when = When());
  void sendControllerCT1(int32_t id, int32_t x, int32_t y, const When& when = When());
  void sendSelfS11(const When& when = When());
  void sendSelfBegin(const When& when = When());
  void sendSelfA11(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t id_{};                  // rebsync: statevar R1.id
  bool stopped_{};                // rebsync: statevar R1.stopped
  std::array<int32_t, 2> pos_{};  // rebsync: statevar R1.pos
  int32_t data_{};                // rebsync: statevar R1.data
  int32_t e11_{};                 // rebsync: env e11
  int32_t sr11_{};                // rebsync: env sr11

  Sensor<R1S11Data> S11_sensor_;
  // rebsync: knownrebec R1.controller
  ros::Publisher controller_CT3_pub_;
  ros::Publisher controller_CT1_pub_;
  ros::Subscriber begin_sub_;
  ros::Subscriber P1_sub_;
  ros::Subscriber A11_sub_;
  ros::Subscriber S11_sub_;
  ros::Publisher state_pub_;
};

}  // namespace running_example

#endif  // RUNNING_EXAMPLE_R1_H
