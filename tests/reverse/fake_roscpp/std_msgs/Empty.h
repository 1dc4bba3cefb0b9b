#ifndef FAKE_STD_MSGS_EMPTY_H
#define FAKE_STD_MSGS_EMPTY_H

#include <ros/ros.h>

FAKE_MESSAGE(std_msgs, Empty, , std::string())

#endif  // FAKE_STD_MSGS_EMPTY_H
