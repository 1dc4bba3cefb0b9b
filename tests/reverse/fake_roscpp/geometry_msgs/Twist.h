#ifndef FAKE_GEOMETRY_MSGS_TWIST_H
#define FAKE_GEOMETRY_MSGS_TWIST_H

#include <geometry_msgs/Vector3.h>

FAKE_MESSAGE(geometry_msgs, Twist, Vector3 linear; Vector3 angular;,
    shown(m.linear) + shown(m.angular))

#endif  // FAKE_GEOMETRY_MSGS_TWIST_H
