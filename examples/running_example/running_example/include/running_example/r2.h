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

// The reactive class R2 of running_example.rebeca: one ROS node for each of its rebecs.
#ifndef RUNNING_EXAMPLE_R2_H
#define RUNNING_EXAMPLE_R2_H

#include <ros/ros.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "running_example/CCT1.h"
#include "running_example/CCT3.h"
#include "running_example/R2A21.h"
#include "running_example/R2Begin.h"
#include "running_example/R2P2.h"
#include "running_example/R2S21.h"
#include "running_example/R2S21Data.h"
#include "running_example/drive.h"
#include "running_example/mailbox.h"
#include "running_example/sensor.h"

namespace running_example {

// rebsync: annotation @Robot
// rebsync: reactiveclass R2
class R2 {
 public:
  R2(const ros::NodeHandle& node, int32_t robot_id, int32_t init_x, int32_t init_y);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct(int32_t robot_id, int32_t init_x, int32_t init_y);

  void begin();
  void P2(int32_t cmd);
  void A21();
  void S21();

  void receiveBegin(const R2Begin::ConstPtr& msg);
  void receiveP2(const R2P2::ConstPtr& msg);
  void receiveA21(const R2A21::ConstPtr& msg);
  void receiveS21(const R2S21::ConstPtr& msg);

  void sendControllerCT3(int32_t id, int32_t x, int32_t y, const When& when = When());
  void sendControllerCT1(int32_t id, int32_t x, int32_t y, const When& when = When());
  void sendSelfS21(const When& when = When());
  void sendSelfBegin(const When& when = When());
  void sendSelfA21(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t id_{};                  // rebsync: statevar R2.id
  bool stopped_{};                // rebsync: statevar R2.stopped
  std::array<int32_t, 2> pos_{};  // rebsync: statevar R2.pos
  int32_t data_{};                // rebsync: statevar R2.data
  int32_t e21_{};                 // rebsync: env e21
  int32_t sr21_{};                // rebsync: env sr21

  Sensor<R2S21Data> S21_sensor_;
  // rebsync: knownrebec R2.controller
  ros::Publisher controller_CT3_pub_;
  ros::Publisher controller_CT1_pub_;
  ros::Subscriber begin_sub_;
  ros::Subscriber P2_sub_;
  ros::Subscriber A21_sub_;
  ros::Subscriber S21_sub_;
  ros::Publisher state_pub_;
};

}  // namespace running_example

#endif  // RUNNING_EXAMPLE_R2_H
