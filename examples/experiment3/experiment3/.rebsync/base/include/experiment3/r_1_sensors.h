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
