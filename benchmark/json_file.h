// SPDX-License-Identifier: BSD-3-Clause
// Scores as scripts read them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace accuracy {

/** \brief Writes an array of runs; false where that is not possible. */
bool
writeRuns (const nlohmann::json& runs, unsigned threads, const std::string& file);

} // namespace accuracy
