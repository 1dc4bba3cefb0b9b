# The stub of rclcpp.
add_library(rclcpp::rclcpp INTERFACE IMPORTED)
target_include_directories(rclcpp::rclcpp INTERFACE "${REBSYNC_STUB}")
