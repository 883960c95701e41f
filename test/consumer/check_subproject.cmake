# SPDX-License-Identifier: BSD-3-Clause
# Builds a project in SCRATCH that has PCL_CREST as a subdirectory: its core alone, without
# PCL, and where there is PCL the adapter as it is by default.
cmake_policy(VERSION 3.22)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
file(REMOVE_RECURSE "${SCRATCH}")
set(configure "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/subproject"
              "-DPCL_CREST=${PCL_CREST}" "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${configure} -B "${SCRATCH}/core" -DPCL_CREST_BUILD_PCL=OFF
    -DCMAKE_DISABLE_FIND_PACKAGE_PCL=ON)
run("${CMAKE_COMMAND}" --build "${SCRATCH}/core" --parallel 2)
if(NOT EXISTS "${SCRATCH}/core/programs/crest_arrays")
  message(FATAL_ERROR "The program is not where its own project puts programs.")
endif()
if(WITH_PCL)
  run(${configure} -B "${SCRATCH}/pcl")
  run("${CMAKE_COMMAND}" --build "${SCRATCH}/pcl" --target pcl_crest_objects --parallel 2)
endif()
