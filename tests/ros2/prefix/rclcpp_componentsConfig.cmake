# Components of the stub: their names are checked to be of a library of this package.
add_library(rclcpp_components::component INTERFACE IMPORTED)

function(rclcpp_components_register_nodes target)
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL "SHARED_LIBRARY" OR NOT ARGN)
    message(FATAL_ERROR "components need a shared library and the names of their classes")
  endif()
endfunction()
