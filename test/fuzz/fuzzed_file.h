// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \brief The name of the file that a target's bytes are, which tells their format. */
extern const char* const FUZZED_FILE;
