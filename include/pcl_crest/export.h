// SPDX-License-Identifier: BSD-3-Clause
// What of a shared library others may call: all else is hidden.
#pragma once

#if defined(__GNUC__)
#define PCL_CREST_EXPORT __attribute__ ((visibility ("default")))
#else
#define PCL_CREST_EXPORT
#endif
