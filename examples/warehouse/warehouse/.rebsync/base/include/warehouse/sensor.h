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

// A real sensor of a robot: keeps the latest message for the model's periodic sampling.
#ifndef WAREHOUSE_SENSOR_H
#define WAREHOUSE_SENSOR_H

#include <ros/ros.h>

#include <boost/optional.hpp>
#include <mutex>
#include <string>
#include <type_traits>

#include "warehouse/mailbox.h"

namespace warehouse {

template <class M>
class Sensor {
 public:
  Sensor(ros::NodeHandle node, const std::string& topic)
      : subscription_(node.subscribe(topic, 1, &Sensor::receive, this)) {}

  /// What `read` makes of the latest message; nothing while none has come.
  template <class Read>
  auto seen(Read read) const -> boost::optional<std::decay_t<decltype(read(M()))>> {
    const typename M::ConstPtr message = latest();
    if (message) return read(*message);
    warn();
    return boost::none;
  }

 private:
  static constexpr double kOneLook = 0.01;  // s, in which a body asks for all that it draws

  // The first sample may take as long as from the model's first look to its second.
  void warn() const {
    const ros::Time now = ros::Time::now();
    if (!first_) first_ = now;
    if ((now - *first_).toSec() < kOneLook || !warned_.again()) return;
    ROS_WARN_STREAM("sensor: nothing on " << subscription_.getTopic());
  }

  void receive(const typename M::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    latest_ = message;
  }

  typename M::ConstPtr latest() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return latest_;
  }

  mutable std::mutex mutex_;
  typename M::ConstPtr latest_;
  mutable boost::optional<ros::Time> first_;  // look that met nothing
  mutable detail::Rarely warned_;
  ros::Subscriber subscription_;
};

}  // namespace warehouse

#endif  // WAREHOUSE_SENSOR_H
