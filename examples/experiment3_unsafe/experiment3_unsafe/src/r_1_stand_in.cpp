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

// Plays the sensors of R_1 with random data, so that the package runs without hardware.
#include <ros/ros.h>

#include <random>

#include "experiment3_unsafe/R1LidarData.h"

namespace {

template <class T>
T draw(std::mt19937& random, std::initializer_list<T> choices) {
  std::uniform_int_distribution<std::size_t> index(0, choices.size() - 1);
  return choices.begin()[index(random)];
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "r_1_stand_in");
  ros::NodeHandle node("~");
  const double time_unit = ros::NodeHandle().param("mailbox/time_unit", 1.0);
  std::mt19937 random(static_cast<uint32_t>(ros::NodeHandle().param("mailbox/seed", 0)));
  ros::Time::waitForValid();

  const ros::Publisher lidar_pub = node.advertise<experiment3_unsafe::R1LidarData>("lidar", 10);
  const auto play_lidar = [&](const ros::TimerEvent& /* event */) {
    experiment3_unsafe::R1LidarData msg;
    msg.obstacle = draw(random, std::initializer_list<bool>{false, true});
    lidar_pub.publish(msg);
  };
  // Half a period from when the model samples, so that it is no chance which data it meets.
  const ros::Duration lidar_period(1.0 * time_unit);
  ros::Timer lidar_timer;
  const auto start_lidar = [&](const ros::TimerEvent& event) {
    play_lidar(event);
    lidar_timer = node.createTimer(lidar_period, play_lidar);
  };
  const ros::Timer lidar_start = node.createTimer(lidar_period * 0.5, start_lidar, true);

  ros::spin();
  return 0;
}
