# Its messages, made before by rosidl.
add_library(std_msgs::std_msgs INTERFACE IMPORTED)
target_include_directories(std_msgs::std_msgs INTERFACE "${REBSYNC_HEADERS}")
set(std_msgs_TARGETS std_msgs::std_msgs)
