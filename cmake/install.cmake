# SPDX-License-Identifier: BSD-3-Clause
# What other projects find after installation: a config package for CMake, a .pc file
# for pkg-config, and the package's manifest where ROS tools look for it.
include(CMakePackageConfigHelpers)

if(NOT PCL_CREST_BUILD_TOOLS)
  set(without_tools PATTERN io EXCLUDE PATTERN visualization EXCLUDE)
endif()
install(DIRECTORY include/pcl_crest DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${without_tools})

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_crest)
configure_package_config_file(cmake/pcl_crestConfig.cmake.in pcl_crestConfig.cmake
                              INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(pcl_crestConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/pcl_crestConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/pcl_crestConfigVersion.cmake"
        DESTINATION ${config_dir})
install(EXPORT pcl_crest_targets NAMESPACE pcl_crest:: DESTINATION ${config_dir})

# Relative to the .pc file, so that `cmake --install --prefix` may still choose.
file(RELATIVE_PATH prefix_from_pc "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
configure_file(cmake/pcl_crest.pc.in pcl_crest.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/pcl_crest.pc"
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/pcl_crest)
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/ament_marker/pcl_crest" "")
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/ament_marker/pcl_crest"
        DESTINATION ${CMAKE_INSTALL_DATADIR}/ament_index/resource_index/packages)
