#ifndef FAKE_STD_MSGS_FLOAT64_H
#define FAKE_STD_MSGS_FLOAT64_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, Float64, double data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_FLOAT64_H
