#ifndef FAKE_STD_MSGS_BOOL_H
#define FAKE_STD_MSGS_BOOL_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, Bool, uint8_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_BOOL_H
