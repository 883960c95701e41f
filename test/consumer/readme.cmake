# SPDX-License-Identifier: BSD-3-Clause
# The C++ of README must stand in the example, which is built, line by line as it is.
file(READ "${README}" readme)
set(EXAMPLE "${EXAMPLES}/crest_lines.cpp")
file(READ "${EXAMPLE}" example)
string(REGEX MATCH "```cpp\n(.*)```\n\nThat is from" found "${readme}")
if(NOT found)
  message(FATAL_ERROR "There is no C++ in ${README} any more: change this check, too.")
endif()
string(FIND "${example}" "${CMAKE_MATCH_1}" place)
if(place EQUAL -1)
  message(FATAL_ERROR "The C++ of ${README} is not what ${EXAMPLE} has:\n${CMAKE_MATCH_1}")
endif()
