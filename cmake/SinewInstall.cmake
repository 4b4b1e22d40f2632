# find_package(sinew) and pkg-config for users of the libraries.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(targets GLOBAL PROPERTY SINEW_TARGETS)
install(TARGETS ${targets} EXPORT sinewTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT sinewTargets NAMESPACE sinew:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sinew)
install(DIRECTORY sinew DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h"
        PATTERN "test" EXCLUDE PATTERN "fuzz" EXCLUDE)
configure_package_config_file(cmake/sinewConfig.cmake.in sinewConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sinew)
write_basic_package_version_file(sinewConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sinewConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/sinewConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sinew)
