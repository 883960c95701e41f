// SPDX-License-Identifier: BSD-3-Clause
// STL, text and binary. It has corners of triangles only: equal ones become one point.
#include "io/file_content.h"
#include "io/number_type.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <unordered_map>

namespace pcl {
namespace crest {

namespace {

constexpr std::size_t HEADER_SIZE = 84;
constexpr std::size_t TRIANGLE_SIZE = 50;

using CornerKey = std::array<std::uint64_t, 3>;

struct CornerHash {
  std::size_t
  operator() (const CornerKey& key) const
  {
    std::size_t hash = 0;
    for (const std::uint64_t x : key)
      hash = hash * 1000003 + (x ^ x >> 32U);
    return hash;
  }
};

/** \brief The number in 37 of its 53 bits, by Veltkamp's splitting: corners that were
 * computed for each triangle anew are still equal in these, and all floats are the
 * same.
 */
double
withoutLastBits (double x)
{
  constexpr double SPLITTER = 65537.0;
  const double product = SPLITTER * x;
  const double rounded = product - (product - x);
  return std::isfinite (rounded) ? rounded : x;
}

/** \brief A corner as bits, in which what is not a number is equal to itself. */
CornerKey
keyOf (const std::array<double, 3>& corner)
{
  CornerKey key{};
  for (std::size_t i = 0; i < 3; ++i) {
    // So that -0 is 0.
    const double x = std::isnan (corner[i]) ? std::numeric_limits<double>::quiet_NaN()
                                            : withoutLastBits (corner[i]) + 0.0;
    std::memcpy (&key[i], &x, sizeof (x));
  }
  return key;
}

/** \brief Collects triangles; points are in the order of their first corner. */
class CornerMerger {
public:
  void
  add (const std::array<double, 3>& corner)
  {
    const auto [place, is_new] = index_of_.emplace (
        keyOf (corner), static_cast<index_t> (content.points.size()));
    if (is_new) {
      content.points.add (corner.data(), false);
      checkPointCount (content.points.size());
    }
    content.faces.corners.push_back (place->second);
  }

  FileContent content;

private:
  std::unordered_map<CornerKey, index_t, CornerHash> index_of_;
};

FileContent
readText (const std::string& text)
{
  TextScanner scanner (text, TextScanner::NO_COMMENTS);
  const auto expect = [&scanner] (const char* wanted) {
    const std::string_view word = scanner.nextWord();
    if (word.empty())
      scanner.fail ("the file ends where \"" + std::string (wanted) +
                    "\" was expected");
    if (word != wanted)
      scanner.fail ("expected \"" + std::string (wanted) + "\", found \"" +
                    TextScanner::shown (word) + "\"");
  };
  CornerMerger merger;
  while (scanner.nextLine()) {
    const std::vector<std::string_view>& words = scanner.words();
    if (words[0] == "solid" || words[0] == "endsolid")
      continue;
    if (words[0] != "facet")
      scanner.fail ("expected \"facet\" or \"endsolid\", found \"" +
                    TextScanner::shown (words[0]) + "\"");
    expect ("outer");
    expect ("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect ("vertex");
      std::array<double, 3> values{};
      for (double& value : values)
        value = scanner.number<double> (scanner.nextWord(), "a coordinate");
      merger.add (values);
    }
    merger.content.faces.close();
    expect ("endloop");
    expect ("endfacet");
  }
  if (text.find ("endsolid") == std::string::npos)
    scanner.fail ("the file ends where \"facet\" or \"endsolid\" was expected");
  return std::move (merger.content);
}

} // namespace

FileContent
readStl (const std::string& text)
{
  // Some programs write a blank before it.
  const std::size_t first = std::min (text.find_first_not_of (" \t\r\n"), text.size());
  const bool says_solid = text.compare (first, 5, "solid") == 0;
  const std::size_t triangles =
      text.size() < HEADER_SIZE
          ? 0
          : decodeAs<std::uint32_t> (text.data() + HEADER_SIZE - 4, false);
  const std::size_t binary_size = HEADER_SIZE + triangles * TRIANGLE_SIZE;
  // The header of a binary file may say "solid" too, so its size decides, and what no
  // text has.
  if (says_solid && text.size() != binary_size && text.find ('\0') == std::string::npos)
    return readText (text);
  if (text.size() < HEADER_SIZE)
    throw ReadError ("it is neither a text STL, which begins with \"solid\", nor a "
                     "binary one, which has at least 84 bytes");
  if (text.size() < binary_size)
    throw ReadError ("a binary STL of " + std::to_string (triangles) +
                     " triangles, as its header says, has " +
                     std::to_string (binary_size) + " bytes, but this one has " +
                     std::to_string (text.size()));
  CornerMerger merger;
  merger.content.has_floats = true;
  for (std::size_t i = 0; i < triangles; ++i) {
    const char* corner = text.data() + HEADER_SIZE + i * TRIANGLE_SIZE + 12;
    for (int j = 0; j < 3; ++j, corner += 12)
      merger.add ({decodeAs<float> (corner, false),
                   decodeAs<float> (corner + 4, false),
                   decodeAs<float> (corner + 8, false)});
    merger.content.faces.close();
  }
  return std::move (merger.content);
}

} // namespace crest
} // namespace pcl
