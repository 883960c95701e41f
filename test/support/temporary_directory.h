// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace oracle {

/** \brief A directory of its own for each test, gone when the test ends. */
class TemporaryDirectory {
public:
  TemporaryDirectory()
  {
    std::string name =
        (std::filesystem::temp_directory_path() / "pcl_crest_XXXXXX").string();
    if (::mkdtemp (name.data()) == nullptr)
      std::abort();
    path_ = name;
  }
  TemporaryDirectory (const TemporaryDirectory&) = delete;
  TemporaryDirectory&
  operator= (const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() { std::filesystem::remove_all (path_); }

  /** \brief The path of a file in it. */
  std::string
  file (const std::string& name) const
  {
    return (path_ / name).string();
  }

  /** \brief The path of a file in it, with this content. */
  std::string
  file (const std::string& name, const std::string& content) const
  {
    std::ofstream (file (name), std::ios::binary) << content;
    return file (name);
  }

  /** \brief The names of all that is in it, sorted. */
  std::vector<std::string>
  names () const
  {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator (path_))
      names.push_back (entry.path().filename().string());
    std::sort (names.begin(), names.end());
    return names;
  }

private:
  std::filesystem::path path_;
};

inline std::string
contentOf (const std::string& file)
{
  std::ifstream stream (file, std::ios::binary);
  return {std::istreambuf_iterator<char> (stream), {}};
}

} // namespace oracle
