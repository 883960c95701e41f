// SPDX-License-Identifier: BSD-3-Clause
// Wavefront OBJ: v, with colors or without, vn and f; all else that an OBJ may hold is
// passed over.
#include "io/color_bytes.h"
#include "io/file_content.h"

#include <algorithm>
#include <cctype>

namespace pcl {
namespace crest {

namespace {

class ObjReader {
public:
  explicit ObjReader (const std::string& text) : scanner_ (text, '#') {}

  FileContent
  read ()
  {
    while (scanner_.nextLine()) {
      while (!scanner_.words().empty() && scanner_.words().back() == "\\" &&
             scanner_.continueLine()) {
      }
      if (!scanner_.words().empty())
        readLine();
    }
    const std::size_t size = content_.points.size();
    checkFaces (content_);
    if (!normals_.empty() && normals_.size() == size && normals_match_) {
      for (std::size_t i = 0; i < size; ++i)
        content_.points.setNormal (i, normals_[i]);
      content_.has_normals = true;
    }
    else if (!normals_.empty())
      content_.notes.push_back (
          "The normals of the file (vn) are not used, as they are not one for each "
          "vertex in the same order.");
    if (colors_.size() == size)
      content_.colors = colorBytes (colors_);
    else if (!colors_.empty())
      content_.notes.push_back ("Only " + std::to_string (colors_.size()) + " of " +
                                std::to_string (size) +
                                " vertices have colors: these are not used.");
    return std::move (content_);
  }

private:
  void
  readLine ()
  {
    const std::string_view keyword = scanner_.words()[0];
    if (keyword == "v") {
      double values[3];
      readCoordinates (values);
      content_.points.add (values, false);
      checkPointCount (content_.points.size());
      // x y z red green blue; a fourth number alone is a weight.
      constexpr std::size_t WITH_COLOR = 7;
      if (scanner_.words().size() >= WITH_COLOR) {
        std::array<float, 3>& color = colors_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
          color[c] = scanner_.number<float> (scanner_.words()[4 + c], "a color");
      }
    }
    else if (keyword == "vn") {
      double values[3];
      readCoordinates (values);
      normals_.push_back (
          Eigen::Vector3d (values[0], values[1], values[2]).cast<float>());
    }
    else if (keyword == "f" || keyword == "fo")
      readFace();
    else if (!std::all_of (keyword.begin(), keyword.end(), [] (unsigned char c) {
               return std::isalpha (c) != 0 || c == '_';
             }))
      scanner_.fail ("expected a keyword of the OBJ format, found \"" +
                     TextScanner::shown (keyword) + "\"");
  }

  void
  readCoordinates (double (&values)[3])
  {
    if (scanner_.words().size() < 4)
      scanner_.fail ("expected 3 coordinates, found " +
                     std::to_string (scanner_.words().size() - 1));
    for (int i = 0; i < 3; ++i)
      values[i] = scanner_.number<double> (scanner_.words()[i + 1], "a coordinate");
  }

  void
  readFace ()
  {
    if (scanner_.words().size() < 4)
      scanner_.fail ("expected at least 3 vertices, found " +
                     std::to_string (scanner_.words().size() - 1));
    for (std::size_t i = 1; i < scanner_.words().size(); ++i) {
      const std::string_view word = scanner_.words()[i];
      const std::size_t first = word.find ('/');
      const index_t vertex = readIndex (word.substr (0, first), content_.points.size());
      content_.faces.corners.push_back (vertex);
      if (first == std::string_view::npos)
        continue;
      const std::size_t second = word.find ('/', first + 1);
      // A slash may stand before nothing: "1//", "1/1/".
      if (second != std::string_view::npos && second + 1 < word.size() &&
          readIndex (word.substr (second + 1), normals_.size()) != vertex)
        normals_match_ = false;
    }
    content_.faces.close();
  }

  /** \brief From 1 in the file, or -1 for the last so far; from 0 here. */
  index_t
  readIndex (std::string_view word, std::size_t so_far) const
  {
    const auto index = scanner_.number<index_t> (word, "the number of a vertex");
    if (index == 0 || index < -static_cast<std::int64_t> (so_far))
      scanner_.fail ("there is no vertex or normal " + std::to_string (index) +
                     " (they count from 1, or backwards from -1)");
    return index > 0
               ? index - 1
               : static_cast<index_t> (static_cast<std::int64_t> (so_far) + index);
  }

  TextScanner scanner_;
  FileContent content_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<std::array<float, 3>> colors_;
  bool normals_match_ = true;
};

} // namespace

FileContent
readObj (const std::string& text)
{
  return ObjReader (text).read();
}

} // namespace crest
} // namespace pcl
