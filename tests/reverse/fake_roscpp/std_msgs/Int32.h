#ifndef FAKE_STD_MSGS_INT32_H
#define FAKE_STD_MSGS_INT32_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, Int32, int32_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_INT32_H
