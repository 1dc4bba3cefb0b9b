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

// The reactive class ControlNode of experiment2_unsafe.rebeca: one ROS node for each of its rebecs.
#ifndef EXPERIMENT2_UNSAFE_CONTROL_NODE_H
#define EXPERIMENT2_UNSAFE_CONTROL_NODE_H

#include <ros/ros.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "experiment2_unsafe/ControlNodeControlTask.h"
#include "experiment2_unsafe/R1P1.h"
#include "experiment2_unsafe/R2P2.h"
#include "experiment2_unsafe/mailbox.h"

namespace experiment2_unsafe {

// rebsync: annotation @Controller
// rebsync: reactiveclass ControlNode
class ControlNode {
 public:
  ControlNode(const ros::NodeHandle& node, int32_t r1x, int32_t r1y, int32_t r2x, int32_t r2y);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct(int32_t r1x, int32_t r1y, int32_t r2x, int32_t r2y);

  void ControlTask(int32_t sender_id, int32_t posX, int32_t posY);

  void receiveControlTask(const ControlNodeControlTask::ConstPtr& msg);

  void sendRobot1P1(int32_t cmd, const When& when = When());
  void sendRobot2P2(int32_t cmd, const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;

  std::array<int32_t, 2> pos_r1_{};  // rebsync: statevar ControlNode.pos_r1
  std::array<int32_t, 2> pos_r2_{};  // rebsync: statevar ControlNode.pos_r2
  int32_t ec1_{};                    // rebsync: env ec1
  int32_t r1_goalX_{};               // rebsync: env r1_goalX
  int32_t r1_goalY_{};               // rebsync: env r1_goalY
  int32_t r2_goalX_{};               // rebsync: env r2_goalX
  int32_t r2_goalY_{};               // rebsync: env r2_goalY

  // rebsync: knownrebec ControlNode.robot1
  ros::Publisher robot1_P1_pub_;
  // rebsync: knownrebec ControlNode.robot2
  ros::Publisher robot2_P2_pub_;
  ros::Subscriber ControlTask_sub_;
  ros::Publisher state_pub_;
};

}  // namespace experiment2_unsafe

#endif  // EXPERIMENT2_UNSAFE_CONTROL_NODE_H
