#ifndef FAKE_GEOMETRY_MSGS_VECTOR3_H
#define FAKE_GEOMETRY_MSGS_VECTOR3_H

#include <ros/ros.h>

FAKE_MESSAGE(geometry_msgs, Vector3, double x{}; double y{}; double z{};,
    fake::value(m.x) + fake::value(m.y) + fake::value(m.z))

#endif  // FAKE_GEOMETRY_MSGS_VECTOR3_H
