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

// The reactive class R1 of experiment2.rebeca: one ROS node for each of its rebecs.
#ifndef EXPERIMENT2_R1_H
#define EXPERIMENT2_R1_H

#include <ros/ros.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "experiment2/ControlNodeControlTask.h"
#include "experiment2/R1Begin.h"
#include "experiment2/R1MoveInX.h"
#include "experiment2/R1P1.h"
#include "experiment2/drive.h"
#include "experiment2/mailbox.h"

namespace experiment2 {

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
  void MoveInX();

  void receiveBegin(const R1Begin::ConstPtr& msg);
  void receiveP1(const R1P1::ConstPtr& msg);
  void receiveMoveInX(const R1MoveInX::ConstPtr& msg);

  void sendControllerControlTask(int32_t sender_id, int32_t posX, int32_t posY,
      const When& when = When());
  void sendSelfBegin(const When& when = When());
  void sendSelfMoveInX(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t id_{};                  // rebsync: statevar R1.id
  bool stopped_{};                // rebsync: statevar R1.stopped
  std::array<int32_t, 2> pos_{};  // rebsync: statevar R1.pos
  int32_t e1_{};                  // rebsync: env e1

  // rebsync: knownrebec R1.controller
  ros::Publisher controller_ControlTask_pub_;
  ros::Subscriber begin_sub_;
  ros::Subscriber P1_sub_;
  ros::Subscriber MoveInX_sub_;
  ros::Publisher state_pub_;
};

}  // namespace experiment2

#endif  // EXPERIMENT2_R1_H
