// SPDX-License-Identifier: BSD-3-Clause
// PTX, Leica's text of one scan or several: of each the numbers of columns and rows,
// the scanner's position and axes, the 4x4 matrix that row vectors are multiplied by,
// then x y z intensity [red green blue] of each point in the scanner's own coordinates,
// where 0 0 0 stands for a beam that did not come back.
#include <Eigen/Core>

#include "io/file_content.h"
#include "io/file_fields.h"

#include <array>
#include <limits>

namespace pcl {
namespace crest {

namespace {

class PtxReader {
public:
  explicit PtxReader (const std::string& text)
  : scanner_ (text, TextScanner::NO_COMMENTS)
  {
    addField (content_.fields, "intensity", NumberType::FLOAT32);
  }

  FileContent
  read ()
  {
    while (scanner_.nextLine())
      readScan();
    if (missing_ != 0)
      content_.notes.push_back (
          std::to_string (missing_) + " of " + std::to_string (content_.points.size()) +
          " beams of the scanner did not come back (0 0 0): their "
          "points are not finite.");
    // What was not registered has its scanner at 0 0 0, as has what forgot it. Several
    // scans have no viewpoint in common.
    if (positions_.size() == 1 && !positions_[0].isZero (0.0))
      content_.viewpoint = positions_[0];
    // Some scans with colors and some without have none.
    if (content_.colors.size() != content_.points.size())
      content_.colors.clear();
    return std::move (content_);
  }

private:
  void
  readScan ()
  {
    const std::size_t columns = readCount ("columns");
    nextLine ("the number of rows");
    const std::size_t rows = readCount ("rows");
    positions_.emplace_back (readNumbers<3> ("the position of the scanner"));
    for (int i = 0; i < 3; ++i)
      readNumbers<3> ("an axis of the scanner");
    Eigen::Matrix4d matrix;
    for (int i = 0; i < 4; ++i)
      matrix.row (i) = readNumbers<4> ("a row of the matrix").transpose();

    checkPointCount (columns);
    checkPointCount (rows);
    const std::size_t points = columns * rows;
    checkPointCount (content_.points.size() + points);
    constexpr std::size_t SHORTEST_ROW = 8; // "0 0 0 0" and the end of the line
    if (points > (scanner_.remaining() + 1) / SHORTEST_ROW)
      scanner_.fail ("the scan should have " + std::to_string (points) +
                     " points, but the file is too short for them");
    content_.points.reserve (content_.points.size() + points);
    for (std::size_t i = 0; i < points; ++i) {
      if (!scanner_.nextLine())
        scanner_.fail ("the file ends after " + std::to_string (i) + " of " +
                       std::to_string (points) + " points of the scan");
      readPoint (matrix);
    }
  }

  void
  readPoint (const Eigen::Matrix4d& matrix)
  {
    const std::size_t width = scanner_.words().size();
    if (width != 4 && width != 7)
      scanner_.fail ("expected x y z intensity, or these and red green blue, found " +
                     std::to_string (width) + " words");
    std::array<double, 7> values{};
    for (std::size_t i = 0; i < width; ++i)
      values[i] = scanner_.number<double> (scanner_.words()[i], "a number");
    Eigen::RowVector4d position (values[0], values[1], values[2], 1.0);
    if (position.head<3>().isZero (0.0)) {
      ++missing_;
      position.setConstant (std::numeric_limits<double>::quiet_NaN());
    }
    else
      position = (position * matrix).eval();
    content_.points.add (position.data(), false);
    encodeNumber (values[3], NumberType::FLOAT32, addRecord (content_.fields));
    if (width == 7) {
      std::array<unsigned char, 3> color{};
      for (std::size_t i = 0; i < 3; ++i) {
        if (!(values[4 + i] >= 0.0 && values[4 + i] <= 255.0))
          scanner_.fail ("expected a color up to 255, found \"" +
                         TextScanner::shown (scanner_.words()[4 + i]) + "\"");
        color[i] = static_cast<unsigned char> (values[4 + i]);
      }
      content_.colors.push_back (color);
    }
  }

  /** \brief The number of this line, which has nothing else. */
  std::size_t
  readCount (const std::string& what)
  {
    if (scanner_.words().size() != 1)
      scanner_.fail ("expected the number of " + what + " of a scan, found " +
                     std::to_string (scanner_.words().size()) + " words");
    return scanner_.number<std::size_t> (scanner_.words()[0],
                                         "the number of " + what + " of a scan");
  }

  template <int N>
  Eigen::Matrix<double, N, 1>
  readNumbers (const std::string& what)
  {
    nextLine (what);
    if (scanner_.words().size() != N)
      scanner_.fail ("expected " + what + ", " + std::to_string (N) +
                     " numbers, found " + std::to_string (scanner_.words().size()) +
                     " words");
    Eigen::Matrix<double, N, 1> numbers;
    for (int i = 0; i < N; ++i)
      numbers[i] = scanner_.number<double> (
          scanner_.words()[static_cast<std::size_t> (i)], "a number");
    return numbers;
  }

  void
  nextLine (const std::string& what)
  {
    if (!scanner_.nextLine())
      scanner_.fail ("the file ends where " + what + " was expected");
  }

  TextScanner scanner_;
  std::size_t missing_ = 0;
  std::vector<Eigen::Vector3d> positions_;
  FileContent content_;
};

} // namespace

FileContent
readPtx (const std::string& text)
{
  return PtxReader (text).read();
}

} // namespace crest
} // namespace pcl
