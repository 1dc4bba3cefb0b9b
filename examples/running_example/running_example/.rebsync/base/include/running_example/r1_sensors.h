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
