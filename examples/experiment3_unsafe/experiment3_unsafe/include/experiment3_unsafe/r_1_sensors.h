// What the sensors of R_1 have seen, as the model's values. Yours to write: regeneration keeps it.
#ifndef EXPERIMENT3_UNSAFE_R_1_SENSORS_H
#define EXPERIMENT3_UNSAFE_R_1_SENSORS_H

#include <cstdint>

#include "experiment3_unsafe/R1LidarData.h"

namespace experiment3_unsafe {

// rebsync: user R_1.sensors
inline bool seenLidar(const R1LidarData& msg) { return msg.obstacle != 0; }
// rebsync: end

}  // namespace experiment3_unsafe

#endif  // EXPERIMENT3_UNSAFE_R_1_SENSORS_H
