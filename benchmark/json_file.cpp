// SPDX-License-Identifier: BSD-3-Clause
#include "json_file.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace accuracy {

bool
writeRuns (const nlohmann::json& runs, unsigned threads, const std::string& file)
{
  std::ofstream stream (file);
  stream << nlohmann::json{{"threads", threads}, {"runs", runs}}.dump (1) << '\n';
  stream.close();
  return !stream.fail();
}

} // namespace accuracy
