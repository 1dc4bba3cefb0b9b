# Its messages, made before by rosidl.
add_library(diagnostic_msgs::diagnostic_msgs INTERFACE IMPORTED)
target_include_directories(diagnostic_msgs::diagnostic_msgs INTERFACE "${REBSYNC_HEADERS}")
set(diagnostic_msgs_TARGETS diagnostic_msgs::diagnostic_msgs)
