#ifndef FAKE_STD_MSGS_INT64_H
#define FAKE_STD_MSGS_INT64_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, Int64, int64_t data{};, fake::value(m.data))

#endif  // FAKE_STD_MSGS_INT64_H
