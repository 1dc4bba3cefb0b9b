#ifndef FAKE_STD_MSGS_INT16_H
#define FAKE_STD_MSGS_INT16_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, Int16, int16_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_INT16_H
