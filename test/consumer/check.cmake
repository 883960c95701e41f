# SPDX-License-Identifier: BSD-3-Clause
# Installs the build in BUILD into a folder of its own below it, builds the examples of the
# README against that, by CMake's package and by pkg-config, and runs them.
cmake_policy(VERSION 3.22)
set(scratch "${BUILD}/consumer")
file(REMOVE_RECURSE "${scratch}")

include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${scratch}/prefix")
run("${CMAKE_COMMAND}" -S "${SOURCE}" -B "${scratch}/build" -DEXAMPLES=${EXAMPLES}
    "-DCMAKE_PREFIX_PATH=${scratch}/prefix" -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${scratch}/build")
file(WRITE "${scratch}/four.xyz" "0 0 0\n1 0 0\n0 1 0\n1 1 0\n")
run("${scratch}/build/read_cloud" "${scratch}/four.xyz")
run("${scratch}/build/consumer" "${CLOUD}")
set(by_cmake "${output}")
if(NOT by_cmake MATCHES "ridge of [0-9]+ points")
  message(FATAL_ERROR "The example found no ridge:\n${by_cmake}")
endif()

# Maps through GDAL by the module that is installed beside the library; without it that is
# said before anything is computed.
file(GLOB_RECURSE gdal "${scratch}/prefix/*/libpcl_crest_gdal*")
set(map "${scratch}/prefix/bin/pcl_crest_line_estimation" "${CLOUD}" "${scratch}/labels.pcd" -quiet
        -lines "${scratch}/lines.gpkg")
if(gdal)
  run(${map})
  if(NOT EXISTS "${scratch}/lines.gpkg")
    message(FATAL_ERROR "There is no GeoPackage.")
  endif()
  file(REMOVE "${gdal}" "${scratch}/lines.gpkg")
endif()
execute_process(COMMAND ${map} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 1 OR NOT output MATCHES "through GDAL" OR EXISTS "${scratch}/lines.gpkg")
  message(FATAL_ERROR "Without GDAL's module it exits with ${result} and says:\n${output}")
endif()

file(GLOB_RECURSE pc_file "${scratch}/prefix/*/pcl_crest.pc")
get_filename_component(pc_dir "${pc_file}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} "${pc_dir}")
run(pkg-config --cflags --libs pcl_crest pcl_io)
separate_arguments(flags UNIX_COMMAND "${output} ${FLAGS}")
get_filename_component(lib_dir "${pc_dir}" DIRECTORY)
run(c++ -std=c++17 -O2 "${EXAMPLES}/crest_lines.cpp" -o "${scratch}/by_pkg_config" ${flags} "-Wl,-rpath,${lib_dir}")
run("${scratch}/by_pkg_config" "${CLOUD}")
if(NOT output STREQUAL by_cmake)
  message(FATAL_ERROR "By pkg-config the example says:\n${output}\nBy CMake:\n${by_cmake}")
endif()

# The core without PCL: neither its package, nor its headers, nor its libraries.
run("${CMAKE_COMMAND}" -S "${SOURCE}/core" -B "${scratch}/core" -DEXAMPLES=${EXAMPLES}
    "-DCMAKE_PREFIX_PATH=${scratch}/prefix" -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_DISABLE_FIND_PACKAGE_PCL=ON "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${scratch}/core")
set(points "")
foreach(i RANGE 0 60)
  math(EXPR x "${i} - 30")
  if(x LESS 0)
    set(slope -1)
    set(height ${x})
  else()
    set(slope 1)
    math(EXPR height "-${x}")
  endif()
  foreach(y RANGE 0 60)
    string(APPEND points "${x} ${y} ${height} ${slope} 0 1\n")
  endforeach()
endforeach()
file(WRITE "${scratch}/roof.xyz" "${points}")
execute_process(COMMAND "${scratch}/core/crest_arrays" INPUT_FILE "${scratch}/roof.xyz"
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0 OR NOT output MATCHES "ridge of [0-9]+ points")
  message(FATAL_ERROR "The core's example found no ridge:\n${output}")
endif()
file(GLOB core "${lib_dir}/libpcl_crest_core.so")
foreach(binary ${core} "${scratch}/core/crest_arrays")
  run(readelf -d "${binary}")
  string(REPLACE "libpcl_crest_core" "" needed "${output}")
  if(needed MATCHES "NEEDED[^\n]*(pcl_|boost|flann|vtk)")
    message(FATAL_ERROR "${binary} needs more than the core may:\n${output}")
  endif()
endforeach()

# Of a shared library others see what is marked alone, and it finds its siblings.
if(core)
  run(nm -DC --defined-only "${core}")
  string(REGEX MATCHALL "[^\n]* T pcl::crest::[^\n]*" exported "${output}")
  list(LENGTH exported count)
  if(NOT output MATCHES "pcl::crest::extractCrests" OR output MATCHES "buildSurfaceGraph"
     OR count GREATER 40)
    message(FATAL_ERROR "The core exports ${count} functions, too many or the wrong:\n${output}")
  endif()
  run(readelf -d "${lib_dir}/libpcl_crest.so")
  string(FIND "${output}" "[$ORIGIN:" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "libpcl_crest.so does not look for libraries beside itself:\n${output}")
  endif()
endif()
