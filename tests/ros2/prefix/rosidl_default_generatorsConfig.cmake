# The real generators of messages that Debian has, and a type support without a middleware.
find_package(ament_cmake_core REQUIRED)
find_package(rosidl_cmake REQUIRED)
find_package(rosidl_adapter REQUIRED)
find_package(rosidl_generator_c REQUIRED)
find_package(rosidl_generator_cpp REQUIRED)
ament_register_extension(
  "rosidl_generate_idl_interfaces" "rosidl_default_generators" "type_support.cmake")
