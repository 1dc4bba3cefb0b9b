#ifndef FAKE_STD_MSGS_FLOAT32_H
#define FAKE_STD_MSGS_FLOAT32_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, Float32, float data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_FLOAT32_H
