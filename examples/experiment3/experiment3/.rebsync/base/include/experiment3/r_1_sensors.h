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

// What the sensors of R_1 have seen, as the model's values. Yours to write: regeneration keeps it.
#ifndef EXPERIMENT3_R_1_SENSORS_H
#define EXPERIMENT3_R_1_SENSORS_H

#include <cstdint>

#include "experiment3/R1LidarData.h"

namespace experiment3 {

// rebsync: user R_1.sensors
inline bool seenLidar(const R1LidarData& msg) { return msg.obstacle != 0; }
// rebsync: end

}  // namespace experiment3

#endif  // EXPERIMENT3_R_1_SENSORS_H
