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

// What the sensors of R1 have seen, as the model's values. Yours to write: regeneration keeps it.
#ifndef RUNNING_EXAMPLE_R1_SENSORS_H
#define RUNNING_EXAMPLE_R1_SENSORS_H

#include <cstdint>

#include "running_example/R1S11Data.h"

namespace running_example {

// rebsync: user R1.sensors
inline int32_t seenS11(const R1S11Data& msg) { return msg.data; }
// rebsync: end

}  // namespace running_example

#endif  // RUNNING_EXAMPLE_R1_SENSORS_H
