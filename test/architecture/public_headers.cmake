# SPDX-License-Identifier: BSD-3-Clause
# Compiles each header below INCLUDE by itself with COMPILER, all warnings being errors:
# those of the core with EIGEN alone in the include path, the others with the folders of
# OTHERS and VTK, too.
cmake_policy(VERSION 3.22)
file(GLOB_RECURSE headers RELATIVE "${INCLUDE}" "${INCLUDE}/*.h" "${INCLUDE}/*.hpp")
list(LENGTH headers count)
if(count LESS 10 OR count GREATER 20)
  message(FATAL_ERROR "There are ${count} public headers: from 10 to 20 are right.")
endif()
set(warnings -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Werror)
set(core_folders)
foreach(folder ${EIGEN})
  list(APPEND core_folders -isystem "${folder}")
endforeach()
# It is searched anyway, and must be so last.
list(REMOVE_ITEM OTHERS /usr/include)
list(REMOVE_ITEM VTK /usr/include)
set(all_folders ${core_folders})
foreach(folder ${OTHERS} ${VTK})
  list(APPEND all_folders -isystem "${folder}")
endforeach()
file(MAKE_DIRECTORY "${SCRATCH}")
foreach(header ${headers})
  set(folders ${core_folders})
  set(of_core TRUE)
  if(header MATCHES "crest_line_estimation|oriented_normal_estimation|/io/|/visualization/")
    set(folders ${all_folders})
    set(of_core FALSE)
  endif()
  file(WRITE "${SCRATCH}/header.cpp" "#include <${header}>\n#include <${header}>\n")
  # Templates warn where they are used.
  if(header MATCHES "impl/crest_line_estimation")
    file(APPEND "${SCRATCH}/header.cpp"
         "template class pcl::CrestLineEstimation<pcl::PointNormal, pcl::PointXYZLNormal>;\n")
  elseif(header MATCHES "impl/")
    file(APPEND "${SCRATCH}/header.cpp"
         "template class pcl::OrientedNormalEstimation<pcl::PointXYZL, pcl::PointNormal>;\n")
  endif()
  execute_process(COMMAND "${COMPILER}" -std=c++17 -fsyntax-only ${warnings} "-I${INCLUDE}"
                          ${folders} "${SCRATCH}/header.cpp"
                  RESULT_VARIABLE result ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "${header}:\n${output}")
  endif()
  if(of_core)
    execute_process(COMMAND "${COMPILER}" -std=c++17 -M "-I${INCLUDE}" ${folders}
                            "${SCRATCH}/header.cpp" OUTPUT_VARIABLE included)
    if(NOT included MATCHES "${header}" OR included MATCHES "/(pcl-?[0-9.]*|boost|flann|vtk[^/]*)/")
      message(SEND_ERROR "${header} includes more than the core may:\n${included}")
    endif()
  endif()
endforeach()
