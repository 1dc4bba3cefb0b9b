# The target that carries the C++ messages of a package.
add_library(${rosidl_generate_interfaces_TARGET}__rosidl_typesupport_cpp INTERFACE)
target_link_libraries(${rosidl_generate_interfaces_TARGET}__rosidl_typesupport_cpp
  INTERFACE ${rosidl_generate_interfaces_TARGET}__rosidl_generator_cpp)
add_dependencies(${rosidl_generate_interfaces_TARGET}__rosidl_typesupport_cpp
  ${rosidl_generate_interfaces_TARGET}__cpp)
install(TARGETS ${rosidl_generate_interfaces_TARGET}__rosidl_typesupport_cpp
  EXPORT export_${rosidl_generate_interfaces_TARGET}__rosidl_typesupport_cpp)
ament_export_targets(export_${rosidl_generate_interfaces_TARGET}__rosidl_typesupport_cpp)
