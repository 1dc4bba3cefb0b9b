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

// Plays the sensors of Lifter with random data, so that the package runs without hardware.
#include <ros/ros.h>

#include <random>

#include "warehouse/LifterWeighData.h"

namespace {

template <class T>
T draw(std::mt19937& random, std::initializer_list<T> choices) {
  std::uniform_int_distribution<std::size_t> index(0, choices.size() - 1);
  return choices.begin()[index(random)];
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "lifter_stand_in");
  ros::NodeHandle node("~");
  const double time_unit = ros::NodeHandle().param("mailbox/time_unit", 1.0);
  std::mt19937 random(static_cast<uint32_t>(ros::NodeHandle().param("mailbox/seed", 0)));
  ros::Time::waitForValid();

  const ros::Publisher weigh_pub = node.advertise<warehouse::LifterWeighData>("weigh", 10);
  const auto play_weigh = [&](const ros::TimerEvent& /* event */) {
    warehouse::LifterWeighData msg;
    msg.heavy = draw(random, std::initializer_list<bool>{false, true});
    weigh_pub.publish(msg);
  };
  // Half a period from when the model samples, so that it is no chance which data it meets.
  const ros::Duration weigh_period(2.0 * time_unit);
  ros::Timer weigh_timer;
  const auto start_weigh = [&](const ros::TimerEvent& event) {
    play_weigh(event);
    weigh_timer = node.createTimer(weigh_period, play_weigh);
  };
  const ros::Timer weigh_start = node.createTimer(weigh_period * 0.5, start_weigh, true);

  ros::spin();
  return 0;
}
