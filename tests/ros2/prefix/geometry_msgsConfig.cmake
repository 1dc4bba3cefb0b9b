# Its messages, made before by rosidl.
add_library(geometry_msgs::geometry_msgs INTERFACE IMPORTED)
target_include_directories(geometry_msgs::geometry_msgs INTERFACE "${REBSYNC_HEADERS}")
set(geometry_msgs_TARGETS geometry_msgs::geometry_msgs)
