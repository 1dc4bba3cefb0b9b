"""CMakeLists, package.xml and message files."""
