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

// The reactive class R_1 of experiment3.rebeca: one ROS node for each of its rebecs.
#ifndef EXPERIMENT3_R_1_H
#define EXPERIMENT3_R_1_H

#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "experiment3/R1Lidar.h"
#include "experiment3/R1LidarData.h"
#include "experiment3/R1MoveForward.h"
#include "experiment3/R1TaskControl.h"
#include "experiment3/drive.h"
#include "experiment3/mailbox.h"
#include "experiment3/sensor.h"

namespace experiment3 {

// rebsync: annotation @Robot
// rebsync: reactiveclass R_1
class R_1 {
 public:
  explicit R_1(const ros::NodeHandle& node);

  Mailbox& mailbox() { return mailbox_; }

 private:
  void construct();

  void taskControl();
  void moveForward();
  void lidar();

  void receiveTaskControl(const R1TaskControl::ConstPtr& msg);
  void receiveMoveForward(const R1MoveForward::ConstPtr& msg);
  void receiveLidar(const R1Lidar::ConstPtr& msg);

  void sendSelfLidar(const When& when = When());
  void sendSelfTaskControl(const When& when = When());
  void sendSelfMoveForward(const When& when = When());

  void publishState(const Served& served);

  Mailbox mailbox_;
  Drive drive_;

  bool moving_{};              // rebsync: statevar R_1.moving
  int32_t current_segment_{};  // rebsync: statevar R_1.current_segment
  bool obstacle_detected_{};   // rebsync: statevar R_1.obstacle_detected
  int32_t e11_{};              // rebsync: env e11
  int32_t sr11_{};             // rebsync: env sr11

  Sensor<R1LidarData> lidar_sensor_;
  ros::Subscriber taskControl_sub_;
  ros::Subscriber moveForward_sub_;
  ros::Subscriber lidar_sub_;
  ros::Publisher state_pub_;
};

}  // namespace experiment3

#endif  // EXPERIMENT3_R_1_H
