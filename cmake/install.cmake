# SPDX-License-Identifier: BSD-3-Clause
# What other projects find after installation: a config package for CMake, a .pc file
# for pkg-config, and the package's manifest where ROS tools look for it.
include(CMakePackageConfigHelpers)

set(components core)
set(not_built)
if(PCL_CREST_BUILD_PCL)
  list(APPEND components pcl)
else()
  list(APPEND not_built PATTERN crest_line_estimation.h EXCLUDE
              PATTERN oriented_normal_estimation.h EXCLUDE PATTERN impl EXCLUDE)
endif()
if(PCL_CREST_BUILD_TOOLS)
  list(APPEND components io visualization)
else()
  list(APPEND not_built PATTERN io EXCLUDE PATTERN visualization EXCLUDE)
endif()
install(DIRECTORY include/pcl_crest DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${not_built})

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_crest)
foreach(component ${components})
  install(EXPORT pcl_crest_${component}_targets NAMESPACE pcl_crest:: DESTINATION ${config_dir})
endforeach()
set(PCL_CREST_COMPONENTS ${components})
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/pcl_crestConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/pcl_crestConfig.cmake" INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/pcl_crestConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/pcl_crestConfig.cmake"
              "${PROJECT_BINARY_DIR}/pcl_crestConfigVersion.cmake"
        DESTINATION ${config_dir})

# Relative to the .pc file, so that `cmake --install --prefix` may still choose.
file(RELATIVE_PATH prefix_from_pc "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
# What a static library does not bring along itself.
set(PCL_CREST_STATIC_LIBS)
if(NOT BUILD_SHARED_LIBS)
  set(PCL_CREST_STATIC_LIBS " ${OpenMP_CXX_FLAGS}")
endif()
set(pc_files pcl_crest_core)
if(PCL_CREST_BUILD_PCL)
  list(APPEND pc_files pcl_crest)
endif()
foreach(name ${pc_files})
  configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc"
                 @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${name}.pc"
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/pcl_crest)
file(WRITE "${PROJECT_BINARY_DIR}/ament_marker/pcl_crest" "")
install(FILES "${PROJECT_BINARY_DIR}/ament_marker/pcl_crest"
        DESTINATION ${CMAKE_INSTALL_DATADIR}/ament_index/resource_index/packages)
