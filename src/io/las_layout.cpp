// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_layout.h"

namespace pcl {
namespace crest {
namespace las {

std::vector<Dimension>
dimensionsOf (unsigned format)
{
  constexpr NumberType U8 = NumberType::UINT8;
  constexpr NumberType U16 = NumberType::UINT16;
  const bool wide = isWide (format);
  std::vector<Dimension> all{{"intensity", U16, 12}};
  if (wide)
    all.insert (all.end(),
                {{"return_number", U8, 14, 0, 0xF},
                 {"number_of_returns", U8, 14, 4, 0xF},
                 {"classification_flags", U8, 15, 0, 0xF},
                 {"scanner_channel", U8, 15, 4, 0x3},
                 {"scan_direction_flag", U8, 15, 6, 0x1},
                 {"edge_of_flight_line", U8, 15, 7, 0x1},
                 {"classification", U8, classByte (format)},
                 {"user_data", U8, 17},
                 {"scan_angle", NumberType::FLOAT32, 18},
                 {"point_source_id", U16, 20}});
  else
    all.insert (all.end(),
                {{"return_number", U8, 14, 0, 0x7},
                 {"number_of_returns", U8, 14, 3, 0x7},
                 {"scan_direction_flag", U8, 14, 6, 0x1},
                 {"edge_of_flight_line", U8, 14, 7, 0x1},
                 {"classification", U8, classByte (format), 0, classMask (format)},
                 {"classification_flags", U8, 15, 5, 0x7},
                 {"scan_angle", NumberType::FLOAT32, 16},
                 {"user_data", U8, 17},
                 {"point_source_id", U16, 18}});
  std::size_t next = wide ? 22 : 20;
  if (wide || format == 1 || format >= 3) {
    all.push_back ({"gps_time", NumberType::FLOAT64, next});
    next += sizeof (double);
  }
  if (format == 2 || format == 3 || format == 5 || format == 7 || format == 8 ||
      format == 10)
    for (const char* const name : {"red", "green", "blue"}) {
      all.push_back ({name, U16, next});
      next += sizeof (std::uint16_t);
    }
  if (format == 8 || format == 10)
    all.push_back ({"nir", U16, next});
  return all;
}

} // namespace las
} // namespace crest
} // namespace pcl
