// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace oracle {

/** \brief A point of a LAS file. */
struct LasPoint {
  std::array<std::int32_t, 3> position;
  std::uint16_t intensity = 0;
  unsigned return_number = 1;
  unsigned returns = 1;
  unsigned code = 0; // its class
  std::uint8_t user_data = 0;
  std::uint16_t source = 0;
  double time = 0.0;
  std::array<std::uint16_t, 3> color{};
  std::uint16_t infrared = 0;
  std::string extra;
};

/** \brief A number behind those of the point format. */
struct LasExtra {
  std::string name;
  std::uint8_t type;
  std::uint8_t options = 0;
  double scale = 0.0;
  double offset = 0.0;
};

/** \brief A LAS file, written number by number as the tables of the specification have
 * them (ASPRS, LAS Specification 1.4 - R15).
 */
struct LasFile {
  unsigned minor = 2;
  unsigned format = 0;
  std::array<double, 3> scale{0.001, 0.001, 0.001};
  std::array<double, 3> offset{};
  std::vector<LasPoint> points;
  std::vector<LasExtra> extra;

  std::string
  bytes () const
  {
    std::string records;
    if (!extra.empty()) {
      add<std::uint16_t> (records, 0);
      addName (records, "LASF_Spec", 16);
      add<std::uint16_t> (records, 4);
      add<std::uint16_t> (records, static_cast<std::uint16_t> (192 * extra.size()));
      addName (records, "", 32);
      for (const LasExtra& e : extra) {
        add<std::uint16_t> (records, 0);
        add (records, e.type);
        add (records, e.options);
        addName (records, e.name, 32);
        addName (records, "", 4 + 3 * 24);
        for (int i = 0; i < 3; ++i)
          add (records, e.scale);
        for (int i = 0; i < 3; ++i)
          add (records, e.offset);
        addName (records, "", 32);
      }
    }
    std::string data;
    for (const LasPoint& point : points)
      addPoint (data, point);
    const std::size_t header_size = minor == 4 ? 375 : minor == 3 ? 235 : 227;
    const bool legacy = minor < 4 || format < 6;
    std::string text = "LASF";
    addName (text, "", 20);
    add<std::uint8_t> (text, 1);
    add (text, static_cast<std::uint8_t> (minor));
    addName (text, "oracle", 32);
    addName (text, "oracle", 32);
    addName (text, "", 4);
    add (text, static_cast<std::uint16_t> (header_size));
    add (text, static_cast<std::uint32_t> (header_size + records.size()));
    add<std::uint32_t> (text, extra.empty() ? 0 : 1);
    add (text, static_cast<std::uint8_t> (format));
    add (text, static_cast<std::uint16_t> (pointSize()));
    add (text, static_cast<std::uint32_t> (legacy ? points.size() : 0));
    addName (text, "", 20);
    for (const auto& numbers : {scale, offset})
      for (const double number : numbers)
        add (text, number);
    addName (text, "", 48);
    if (minor >= 3)
      add<std::uint64_t> (text, 0);
    if (minor == 4) {
      addName (text, "", 12);
      add<std::uint64_t> (text, points.size());
      addName (text, "", 120);
    }
    return text + records + data;
  }

  std::size_t
  pointSize () const
  {
    const std::size_t sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    return sizes[format] + (points.empty() ? 0 : points[0].extra.size());
  }

private:
  template <typename T>
  static void
  add (std::string& text, T number)
  {
    char bytes[sizeof (T)];
    std::memcpy (bytes, &number, sizeof (T));
    text.append (bytes, sizeof (T));
  }

  static void
  addName (std::string& text, const std::string& name, std::size_t size)
  {
    text += name + std::string (size - name.size(), '\0');
  }

  void
  addPoint (std::string& data, const LasPoint& point) const
  {
    const bool wide = format >= 6;
    for (const std::int32_t number : point.position)
      add (data, number);
    add (data, point.intensity);
    const unsigned shift = wide ? 4 : 3;
    add (data,
         static_cast<std::uint8_t> (point.return_number | point.returns << shift));
    if (wide)
      add<std::uint8_t> (data, 0);
    add (data, static_cast<std::uint8_t> (point.code));
    if (!wide)
      add<std::int8_t> (data, 0);
    add (data, point.user_data);
    if (wide)
      add<std::int16_t> (data, 0);
    add (data, point.source);
    if (format == 1 || format >= 3)
      add (data, point.time);
    if (format == 2 || format == 3 || format == 5 || format == 7 || format == 8 ||
        format == 10)
      for (const std::uint16_t channel : point.color)
        add (data, channel);
    if (format == 8 || format == 10)
      add (data, point.infrared);
    if (format == 4 || format == 5 || format >= 9)
      addName (data, "", 29);
    data += point.extra;
  }
};

} // namespace oracle
