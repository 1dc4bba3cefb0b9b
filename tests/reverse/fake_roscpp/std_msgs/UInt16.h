#ifndef FAKE_STD_MSGS_UINT16_H
#define FAKE_STD_MSGS_UINT16_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, UInt16, uint16_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_UINT16_H
