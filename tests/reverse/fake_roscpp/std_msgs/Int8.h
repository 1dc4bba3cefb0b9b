#ifndef FAKE_STD_MSGS_INT8_H
#define FAKE_STD_MSGS_INT8_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, Int8, int8_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_INT8_H
