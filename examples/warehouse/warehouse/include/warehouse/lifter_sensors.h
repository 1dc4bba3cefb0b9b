// What the sensors of Lifter have seen, as the model's values. Yours to write: regeneration keeps it.
#ifndef WAREHOUSE_LIFTER_SENSORS_H
#define WAREHOUSE_LIFTER_SENSORS_H

#include <cstdint>

#include "warehouse/LifterWeighData.h"

namespace warehouse {

// rebsync: user Lifter.sensors
inline bool seenWeigh(const LifterWeighData& msg) { return msg.heavy != 0; }
// rebsync: end

}  // namespace warehouse

#endif  // WAREHOUSE_LIFTER_SENSORS_H
