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

// The reactive class R2 of experiment2.rebeca: one ROS node for each of its rebecs.
#ifndef EXPERIMENT2_R2_H
#define EXPERIMENT2_R2_H

#include <ros/ros.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "experiment2/ControlNodeControlTask.h"
#include "experiment2/R2Begin.h"
#include "experiment2/R2MoveInY.h"
#include "experiment2/R2P2.h"
#include "experiment2/drive.h"
#include "experiment2/mailbox.h"

namespace experiment2 {

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
  void MoveInY();

  void receiveBegin(const R2Begin::ConstPtr& msg);
  void receiveP2(const R2P2::ConstPtr& msg);
  void receiveMoveInY(const R2MoveInY::ConstPtr& msg);

  void sendControllerControlTask(int32_t sender_id, int32_t posX, int32_t posY,
      const When& when = When());
  void sendSelfBegin(const When& when = When());
  void sendSelfMoveInY(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  int32_t id_{};                  // rebsync: statevar R2.id
  bool stopped_{};                // rebsync: statevar R2.stopped
  std::array<int32_t, 2> pos_{};  // rebsync: statevar R2.pos
  int32_t e2_{};                  // rebsync: env e2

  // rebsync: knownrebec R2.controller
  ros::Publisher controller_ControlTask_pub_;
  ros::Subscriber begin_sub_;
  ros::Subscriber P2_sub_;
  ros::Subscriber MoveInY_sub_;
  ros::Publisher state_pub_;
};

}  // namespace experiment2

#endif  // EXPERIMENT2_R2_H
