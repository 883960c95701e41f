# SPDX-License-Identifier: BSD-3-Clause
# pcl_crest_library(NAME [INTERNAL] COMPONENT component [EXPORT_NAME name] SOURCES ...
# PUBLIC ... PRIVATE ...): a library of the project, of which others see what is marked
# PCL_CREST_EXPORT alone. They link pcl_crest::NAME, or pcl_crest::EXPORT_NAME, and find
# it where they ask the package for the component. PUBLIC and PRIVATE are what it links.
#
# With INTERNAL there is the same code as a static library NAME_internal, too, for tests
# and benchmarks that call what others do not see.
function(pcl_crest_library name)
  cmake_parse_arguments(arg "INTERNAL" "COMPONENT;EXPORT_NAME" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(arg_INTERNAL)
    set(compiled ${name}_objects)
    add_library(${compiled} OBJECT ${arg_SOURCES})
    set_target_properties(${compiled} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${compiled} PRIVATE ${arg_PUBLIC} ${arg_PRIVATE})
    add_library(${name} $<TARGET_OBJECTS:${compiled}>)
    add_library(${name}_internal STATIC EXCLUDE_FROM_ALL $<TARGET_OBJECTS:${compiled}>)
    target_include_directories(
      ${name}_internal PUBLIC "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/src")
    foreach(dependency ${arg_PUBLIC} ${arg_PRIVATE})
      if(TARGET ${dependency}_internal)
        string(APPEND dependency _internal)
      endif()
      target_link_libraries(${name}_internal PUBLIC ${dependency})
    endforeach()
  else()
    set(compiled ${name})
    add_library(${name} ${arg_SOURCES})
  endif()
  set_target_properties(${compiled} PROPERTIES CXX_VISIBILITY_PRESET hidden
                                               VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(${compiled} PRIVATE "${PROJECT_SOURCE_DIR}/include"
                                                 "${PROJECT_SOURCE_DIR}/src")

  target_compile_features(${name} PUBLIC cxx_std_17)
  target_include_directories(
    ${name} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                   "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  set_target_properties(${name} PROPERTIES VERSION ${PROJECT_VERSION}
                                           SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  set(exported ${name})
  if(arg_EXPORT_NAME)
    set(exported ${arg_EXPORT_NAME})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${exported})
  endif()
  add_library(pcl_crest::${exported} ALIAS ${name})
  if(PCL_CREST_INSTALL)
    install(TARGETS ${name} EXPORT pcl_crest_${arg_COMPONENT}_targets
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
            RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endfunction()
