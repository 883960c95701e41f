// SPDX-License-Identifier: BSD-3-Clause
#include "fuzzed_file.h"

const char* const FUZZED_FILE = PCL_CREST_FUZZED_FILE;
