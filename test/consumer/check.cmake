# SPDX-License-Identifier: BSD-3-Clause
# Installs the build in BUILD into a folder of its own below it, builds the example of the
# README against that, by CMake's package and by pkg-config, and runs it on CLOUD.
set(scratch "${BUILD}/consumer")
file(REMOVE_RECURSE "${scratch}")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${scratch}/prefix")
run("${CMAKE_COMMAND}" -S "${SOURCE}" -B "${scratch}/build" -DEXAMPLE=${EXAMPLE}
    "-DCMAKE_PREFIX_PATH=${scratch}/prefix" -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${scratch}/build")
# The reader of PCD files is loaded from where the library is; nothing else needs it.
run("${scratch}/build/read_cloud" "${CLOUD}")
file(GLOB_RECURSE module "${scratch}/prefix/*/libpcl_crest_pcd.so")
if(module)
  file(RENAME "${module}" "${module}.away")
  execute_process(COMMAND "${scratch}/build/read_cloud" "${CLOUD}" RESULT_VARIABLE result
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 2 OR NOT output MATCHES "could not be loaded from")
    message(FATAL_ERROR "Without its module the reader exits with ${result}:\n${output}")
  endif()
  file(WRITE "${scratch}/four.xyz" "0 0 0\n1 0 0\n0 1 0\n1 1 0\n")
  run("${scratch}/build/read_cloud" "${scratch}/four.xyz")
  file(RENAME "${module}.away" "${module}")
endif()
run("${scratch}/build/consumer" "${CLOUD}")
set(by_cmake "${output}")
if(NOT by_cmake MATCHES "ridge of [0-9]+ points")
  message(FATAL_ERROR "The example found no ridge:\n${by_cmake}")
endif()

file(GLOB_RECURSE pc_file "${scratch}/prefix/*/pcl_crest.pc")
get_filename_component(pc_dir "${pc_file}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} "${pc_dir}")
run(pkg-config --cflags --libs pcl_crest pcl_io)
separate_arguments(flags UNIX_COMMAND "${output} ${FLAGS}")
get_filename_component(lib_dir "${pc_dir}" DIRECTORY)
run(c++ -std=c++17 -O2 "${EXAMPLE}" -o "${scratch}/by_pkg_config" ${flags} "-Wl,-rpath,${lib_dir}")
run("${scratch}/by_pkg_config" "${CLOUD}")
if(NOT output STREQUAL by_cmake)
  message(FATAL_ERROR "By pkg-config the example says:\n${output}\nBy CMake:\n${by_cmake}")
endif()
