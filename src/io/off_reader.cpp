// SPDX-License-Identifier: BSD-3-Clause
// The Object File Format of Geomview: [ST][C][N]OFF in text form.
#include "io/file_content.h"

namespace pcl {
namespace crest {

namespace {

/** \brief The kinds of OFF by their first word; whether it is one with normals. */
bool
headerHasNormals (const TextScanner& scanner, std::string_view header)
{
  if (header.size() < 3 || header.substr (header.size() - 3) != "OFF")
    scanner.fail ("expected the header OFF, found \"" + TextScanner::shown (header) +
                  "\"");
  std::string_view prefix = header.substr (0, header.size() - 3);
  const auto take = [&prefix] (std::string_view part) {
    const bool found = prefix.substr (0, part.size()) == part;
    if (found)
      prefix.remove_prefix (part.size());
    return found;
  };
  take ("ST");
  take ("C");
  const bool normals = take ("N");
  if (!prefix.empty())
    scanner.fail ("OFF files with the header \"" + TextScanner::shown (header) +
                  "\" are not supported, only OFF, COFF, NOFF and CNOFF are");
  return normals;
}

} // namespace

FileContent
readOff (const std::string& text)
{
  TextScanner scanner (text, '#');
  if (!scanner.nextLine())
    scanner.fail ("expected the header OFF, found nothing");
  std::vector<std::string_view> words = scanner.words();
  FileContent content;
  content.has_normals = headerHasNormals (scanner, words[0]);
  words.erase (words.begin());
  if (!words.empty() && words[0] == "BINARY")
    scanner.fail ("binary OFF files are not supported, only text ones are");
  if (words.empty() && scanner.nextLine())
    words = scanner.words();
  if (words.size() < 2)
    scanner.fail ("expected the numbers of vertices and of faces");
  const auto vertices =
      scanner.number<std::int64_t> (words[0], "the number of vertices");
  const auto faces = scanner.number<std::int64_t> (words[1], "the number of faces");
  if (vertices < 0 || faces < 0)
    scanner.fail ("the numbers of vertices and of faces must not be negative");
  checkPointCount (static_cast<std::size_t> (vertices));

  const auto lineOf =
      [&scanner] (const char* what, std::int64_t i, std::int64_t count) {
        if (!scanner.nextLine())
          scanner.fail ("the file ends after " + std::to_string (i) + " of " +
                        std::to_string (count) + " " + what);
      };
  const std::size_t numbers = content.has_normals ? 6 : 3;
  for (std::int64_t i = 0; i < vertices; ++i) {
    lineOf ("vertices", i, vertices);
    if (scanner.words().size() < numbers)
      scanner.fail ("expected " + std::to_string (numbers) + " coordinates, found " +
                    std::to_string (scanner.words().size()));
    double values[6];
    for (std::size_t j = 0; j < numbers; ++j)
      values[j] = scanner.number<double> (scanner.words()[j], "a coordinate");
    content.points.add (values, content.has_normals);
  }
  for (std::int64_t i = 0; i < faces; ++i) {
    lineOf ("faces", i, faces);
    const auto corners =
        scanner.number<std::size_t> (scanner.words()[0], "the number of corners");
    if (corners > scanner.words().size() - 1)
      scanner.fail ("expected " + std::to_string (corners) + " vertices, found " +
                    std::to_string (scanner.words().size() - 1));
    for (std::size_t j = 1; j <= corners; ++j) {
      const auto corner = scanner.number<index_t> (scanner.words()[j], "a vertex");
      if (corner < 0 || corner >= vertices)
        scanner.fail ("vertex " + std::to_string (corner) + " is not one of the " +
                      std::to_string (vertices) + " (they count from 0)");
      content.faces.corners.push_back (corner);
    }
    content.faces.close();
  }
  return content;
}

} // namespace crest
} // namespace pcl
