include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nlcwfs)
install(EXPORT nlcwfsTargets NAMESPACE nlcwfs:: DESTINATION ${package_dir})
file(READ cmake/Dependencies.cmake dependencies)
configure_package_config_file(cmake/nlcwfsConfig.cmake.in nlcwfsConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(nlcwfsConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nlcwfsConfig.cmake
              ${PROJECT_BINARY_DIR}/nlcwfsConfigVersion.cmake DESTINATION ${package_dir})
