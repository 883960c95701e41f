// SPDX-License-Identifier: BSD-3-Clause
#include "io/unread_formats.h"

#include <boost/algorithm/string/predicate.hpp>

#include "io/las_layout.h"

#include <filesystem>

namespace pcl {
namespace crest {

namespace {

/** \brief As the programs that convert it call it. */
std::string
quotedName (const std::filesystem::path& file)
{
  return "\"" + file.string() + "\"";
}

} // namespace

std::string
explainUnread (const std::string& file,
               const std::string& extension,
               const std::string& text)
{
  // LASzip marks compressed points by the two highest bits of their format.
  constexpr unsigned COMPRESSED = 0xC0;
  // The first record of a COPC file is its own (COPC Specification 1.0).
  constexpr std::size_t FIRST_RECORD = las::HEADER_SIZES[2];
  const bool is_las = boost::starts_with (text, "LASF");
  const bool is_laz =
      is_las && text.size() > las::POINT_FORMAT &&
      (static_cast<unsigned char> (text[las::POINT_FORMAT]) & COMPRESSED) != 0;
  std::filesystem::path las = std::filesystem::path (file).stem();
  if (las.extension() == ".copc")
    las = las.stem();
  las += ".las";
  const std::string by_pdal = "convert it to LAS by pdal translate " +
                              quotedName (file) + " " + quotedName (las);
  if (is_laz && text.size() > FIRST_RECORD + las::USER &&
      text.compare (FIRST_RECORD + las::USER, 4, "copc") == 0)
    return "it is a COPC file, whose points are compressed: " + by_pdal;
  if (is_laz || (extension == ".laz" && !is_las))
    return "it is a LAZ file, whose points are compressed: " + by_pdal +
           ", by laszip -i " + quotedName (file) + " -o " + quotedName (las) +
           ", or with CloudCompare";
  if (boost::starts_with (text, "ASTM-E57") || extension == ".e57")
    return "it is an E57 file, which is not read: " + by_pdal +
           ", or save it as PLY with CloudCompare";
  return {};
}

} // namespace crest
} // namespace pcl
