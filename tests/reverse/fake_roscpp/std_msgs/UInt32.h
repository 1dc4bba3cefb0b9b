#ifndef FAKE_STD_MSGS_UINT32_H
#define FAKE_STD_MSGS_UINT32_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, UInt32, uint32_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_UINT32_H
