#ifndef FAKE_STD_MSGS_UINT8_H
#define FAKE_STD_MSGS_UINT8_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, UInt8, uint8_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_UINT8_H
