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

/** \brief A variable length record of a LAS file. */
struct LasRecord {
  std::string user;
  std::uint16_t id = 0;
  std::string description;
  std::string data;

  bool
  operator== (const LasRecord& other) const
  {
    return user == other.user && id == other.id && description == other.description &&
           data == other.data;
  }
};

/** \brief The records of a file between its header and its points. */
inline std::vector<LasRecord>
lasRecordsOf (const std::string& text)
{
  const auto at = [&text] (auto& number, std::size_t byte) {
    std::memcpy (&number, text.data() + byte, sizeof (number));
  };
  const auto name = [&text] (std::size_t byte, std::size_t size) {
    const std::string room = text.substr (byte, size);
    return room.substr (0, room.find ('\0'));
  };
  std::uint16_t size = 0;
  std::uint32_t count = 0;
  at (size, 94);
  at (count, 100);
  std::vector<LasRecord> records;
  for (std::size_t byte = size; count > 0; --count, byte += 54 + size) {
    std::uint16_t id = 0;
    at (id, byte + 18);
    at (size, byte + 20);
    records.push_back (
        {name (byte + 2, 16), id, name (byte + 22, 32), text.substr (byte + 54, size)});
  }
  return records;
}

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
  std::vector<LasRecord> records;
  /** those behind the points */
  std::vector<LasRecord> extended;

  std::string
  bytes () const
  {
    std::string head;
    for (const LasRecord& record : records) {
      addHead (head, record);
      add (head, static_cast<std::uint16_t> (record.data.size()));
      addName (head, record.description, 32);
      head += record.data;
    }
    if (!extra.empty()) {
      add<std::uint16_t> (head, 0);
      addName (head, "LASF_Spec", 16);
      add<std::uint16_t> (head, 4);
      add<std::uint16_t> (head, static_cast<std::uint16_t> (192 * extra.size()));
      addName (head, "", 32);
      for (const LasExtra& e : extra) {
        add<std::uint16_t> (head, 0);
        add (head, e.type);
        add (head, e.options);
        addName (head, e.name, 32);
        addName (head, "", 4 + 3 * 24);
        for (int i = 0; i < 3; ++i)
          add (head, e.scale);
        for (int i = 0; i < 3; ++i)
          add (head, e.offset);
        addName (head, "", 32);
      }
    }
    std::string data;
    for (const LasPoint& point : points)
      addPoint (data, point);
    const std::size_t points_end = data.size();
    for (const LasRecord& record : extended) {
      addHead (data, record);
      add (data, static_cast<std::uint64_t> (record.data.size()));
      addName (data, record.description, 32);
      data += record.data;
    }
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
    add (text, static_cast<std::uint32_t> (header_size + head.size()));
    add (text, static_cast<std::uint32_t> (records.size() + (extra.empty() ? 0 : 1)));
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
      add<std::uint64_t> (text, header_size + head.size() + points_end);
      add (text, static_cast<std::uint32_t> (extended.size()));
      add<std::uint64_t> (text, points.size());
      addName (text, "", 120);
    }
    return text + head + data;
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

  static void
  addHead (std::string& text, const LasRecord& record)
  {
    add<std::uint16_t> (text, 0);
    addName (text, record.user, 16);
    add (text, record.id);
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
