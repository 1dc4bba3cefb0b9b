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

// The reactive class R_1 of experiment1.rebeca: one ROS node for each of its rebecs.
#ifndef EXPERIMENT1_R_1_H
#define EXPERIMENT1_R_1_H

#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "experiment1/R1MoveBackward.h"
#include "experiment1/R1MoveForward.h"
#include "experiment1/R1TaskControl.h"
#include "experiment1/R1WaitForCharge.h"
#include "experiment1/drive.h"
#include "experiment1/mailbox.h"

namespace experiment1 {

// rebsync: annotation @Robot
// rebsync: reactiveclass R_1
class R_1 {
 public:
  R_1(const ros::NodeHandle& node, int32_t fuel_capacity_initial, int32_t fuel_per_step_initial);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct(int32_t fuel_capacity_initial, int32_t fuel_per_step_initial);

  void taskControl();
  void moveForward();
  void moveBackward();
  void waitForCharge();

  void receiveTaskControl(const R1TaskControl::ConstPtr& msg);
  void receiveMoveForward(const R1MoveForward::ConstPtr& msg);
  void receiveMoveBackward(const R1MoveBackward::ConstPtr& msg);
  void receiveWaitForCharge(const R1WaitForCharge::ConstPtr& msg);

  void sendSelfTaskControl(const When& when = When());
  void sendSelfMoveForward(const When& when = When());
  void sendSelfMoveBackward(const When& when = When());
  void sendSelfWaitForCharge(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t fuel_capacity_{};    // rebsync: statevar R_1.fuel_capacity
  int32_t fuel_per_step_{};    // rebsync: statevar R_1.fuel_per_step
  int32_t remaining_fuel_{};   // rebsync: statevar R_1.remaining_fuel
  bool moving_{};              // rebsync: statevar R_1.moving
  int32_t current_segment_{};  // rebsync: statevar R_1.current_segment
  bool direct_moving_{};       // rebsync: statevar R_1.direct_moving
  int32_t e11_{};              // rebsync: env e11
  int32_t e12_{};              // rebsync: env e12
  int32_t fuel_threshold_{};   // rebsync: env fuel_threshold
  int32_t chargeTime_{};       // rebsync: env chargeTime

  ros::Subscriber taskControl_sub_;
  ros::Subscriber moveForward_sub_;
  ros::Subscriber moveBackward_sub_;
  ros::Subscriber waitForCharge_sub_;
  ros::Publisher state_pub_;
};

}  // namespace experiment1

#endif  // EXPERIMENT1_R_1_H
