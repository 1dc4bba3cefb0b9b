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

// The reactive class C of running_example.rebeca: one ROS node for each of its rebecs.
#ifndef RUNNING_EXAMPLE_C_H
#define RUNNING_EXAMPLE_C_H

#include <ros/ros.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "running_example/CCT1.h"
#include "running_example/CCT2.h"
#include "running_example/CCT3.h"
#include "running_example/R1P1.h"
#include "running_example/R2P2.h"
#include "running_example/mailbox.h"

namespace running_example {

// rebsync: annotation @Controller
// rebsync: reactiveclass C
class C {
 public:
  C(const ros::NodeHandle& node, int32_t x1, int32_t y1, int32_t x2, int32_t y2);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct(int32_t x1, int32_t y1, int32_t x2, int32_t y2);

  void CT1(int32_t id, int32_t x, int32_t y);
  void CT2(int32_t id);
  void CT3(int32_t id, int32_t x, int32_t y);

  bool occupied(int32_t id, int32_t x, int32_t y);
  void command(int32_t id, int32_t cmd);

  void receiveCT1(const CCT1::ConstPtr& msg);
  void receiveCT2(const CCT2::ConstPtr& msg);
  void receiveCT3(const CCT3::ConstPtr& msg);

  void sendRobot1P1(int32_t cmd, const When& when = When());
  void sendRobot2P2(int32_t cmd, const When& when = When());
  void sendSelfCT1(int32_t id, int32_t x, int32_t y, const When& when = When());
  void sendSelfCT2(int32_t id, const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;

  std::array<int32_t, 2> pos1_{};  // rebsync: statevar C.pos1
  std::array<int32_t, 2> pos2_{};  // rebsync: statevar C.pos2
  int32_t moving_{};               // rebsync: statevar C.moving
  int32_t ec1_{};                  // rebsync: env ec1
  int32_t ec2_{};                  // rebsync: env ec2
  int32_t ec3_{};                  // rebsync: env ec3
  int32_t r1_goal_x_{};            // rebsync: env r1_goal_x
  int32_t r1_goal_y_{};            // rebsync: env r1_goal_y
  int32_t r2_goal_x_{};            // rebsync: env r2_goal_x
  int32_t r2_goal_y_{};            // rebsync: env r2_goal_y

  // rebsync: knownrebec C.robot1
  ros::Publisher robot1_P1_pub_;
  // rebsync: knownrebec C.robot2
  ros::Publisher robot2_P2_pub_;
  ros::Subscriber CT1_sub_;
  ros::Subscriber CT2_sub_;
  ros::Subscriber CT3_sub_;
  ros::Publisher state_pub_;
};

}  // namespace running_example

#endif  // RUNNING_EXAMPLE_C_H
