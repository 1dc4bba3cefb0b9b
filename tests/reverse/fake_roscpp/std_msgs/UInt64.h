#ifndef FAKE_STD_MSGS_UINT64_H
#define FAKE_STD_MSGS_UINT64_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, UInt64, uint64_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_UINT64_H
