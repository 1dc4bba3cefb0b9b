# Its messages, made before by rosidl.
add_library(rcl_interfaces::rcl_interfaces INTERFACE IMPORTED)
target_include_directories(rcl_interfaces::rcl_interfaces INTERFACE "${REBSYNC_HEADERS}")
set(rcl_interfaces_TARGETS rcl_interfaces::rcl_interfaces)
