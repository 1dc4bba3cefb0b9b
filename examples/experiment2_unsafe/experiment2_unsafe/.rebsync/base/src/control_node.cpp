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

#include "experiment2_unsafe/control_node.h"

#include "experiment2_unsafe/ControlNodeState.h"

namespace experiment2_unsafe {

namespace {

constexpr Server kControlTask{"ControlTask", kNoPriority};

}  // namespace

ControlNode::ControlNode(const ros::NodeHandle& node, int32_t r1x, int32_t r1y, int32_t r2x,
    int32_t r2y)
    : mailbox_(node, 4) {
  robot1_P1_pub_ = mailbox_.advertise<R1P1>("robot1/P1");
  robot2_P2_pub_ = mailbox_.advertise<R2P2>("robot2/P2");
  const ros::NodeHandle global;
  ec1_ = global.param("ec1", 1);
  r1_goalX_ = global.param("r1_goalX", 4);
  r1_goalY_ = global.param("r1_goalY", 2);
  r2_goalX_ = global.param("r2_goalX", 2);
  r2_goalY_ = global.param("r2_goalY", 4);
  ControlTask_sub_ = mailbox_.subscribeOnBridge("ControlTask", &ControlNode::receiveControlTask, this);
  state_pub_ = ros::NodeHandle(node).advertise<ControlNodeState>("state", kQueueSize, true);
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([=] { construct(r1x, r1y, r2x, r2y); });
}

// rebsync: constructor ControlNode
void ControlNode::construct(int32_t r1x, int32_t r1y, int32_t r2x, int32_t r2y) {
  pos_r1_[0] = r1x;
  pos_r1_[1] = r1y;
  pos_r2_[0] = r2x;
  pos_r2_[1] = r2y;
}

// rebsync: msgsrv ControlNode.ControlTask
void ControlNode::ControlTask(int32_t sender_id, int32_t posX, int32_t posY) {
  mailbox_.delay(ec1_);
  if (sender_id == 0) {
    pos_r1_[0] = posX;
    pos_r1_[1] = posY;
    if (pos_r1_[0] == r1_goalX_ && pos_r1_[1] == r1_goalY_) {
      sendRobot1P1(0);
    } else if (pos_r1_[0] + 1 == pos_r2_[0] && pos_r1_[1] == pos_r2_[1]) {
      sendRobot1P1(2);
    } else {
      sendRobot1P1(1);
    }
  } else if (sender_id == 1) {
    pos_r2_[0] = posX;
    pos_r2_[1] = posY;
    if (pos_r2_[0] == r2_goalX_ && pos_r2_[1] == r2_goalY_) {
      sendRobot2P2(0);
    } else if (pos_r2_[0] == pos_r1_[0] && pos_r2_[1] + 1 == pos_r1_[1]) {
      sendRobot2P2(2);
    } else {
      sendRobot2P2(1);
    }
  }
}

void ControlNode::receiveControlTask(const ControlNodeControlTask::ConstPtr& msg) {
  mailbox_.receive(kControlTask, msg->timing, "", text(msg->sender_id, msg->pos_x, msg->pos_y),
      [this, msg] { ControlTask(msg->sender_id, msg->pos_x, msg->pos_y); });
}

// rebsync: send ControlNode.robot1.P1
void ControlNode::sendRobot1P1(int32_t cmd, const When& when) {
  R1P1 msg;
  msg.cmd = cmd;
  mailbox_.publish(robot1_P1_pub_, msg, when);
}

// rebsync: send ControlNode.robot2.P2
void ControlNode::sendRobot2P2(int32_t cmd, const When& when) {
  R2P2 msg;
  msg.cmd = cmd;
  mailbox_.publish(robot2_P2_pub_, msg, when);
}

void ControlNode::publishState(const Served& served) {
  ControlNodeState msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  flatten(pos_r1_, msg.pos_r1);
  flatten(pos_r2_, msg.pos_r2);
  state_pub_.publish(msg);
}

}  // namespace experiment2_unsafe
