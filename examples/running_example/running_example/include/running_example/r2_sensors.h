// What the sensors of R2 have seen, as the model's values. Yours to write: regeneration keeps it.
#ifndef RUNNING_EXAMPLE_R2_SENSORS_H
#define RUNNING_EXAMPLE_R2_SENSORS_H

#include <cstdint>

#include "running_example/R2S21Data.h"

namespace running_example {

// rebsync: user R2.sensors
inline int32_t seenS21(const R2S21Data& msg) { return msg.data; }
// rebsync: end

}  // namespace running_example

#endif  // RUNNING_EXAMPLE_R2_SENSORS_H
