// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.h"

#include "io/text_scanner.h"

#include <algorithm>
#include <cstring>

namespace pcl {
namespace crest {

namespace {

/** \brief Takes bytes off the front of data. */
class PackedBytes {
public:
  explicit PackedBytes (std::string_view data) : data_ (data) {}

  bool
  isEmpty () const
  {
    return data_.empty();
  }

  std::string_view
  take (std::size_t count)
  {
    if (count > data_.size())
      throw ReadError ("its compressed data are cut off");
    const std::string_view bytes = data_.substr (0, count);
    data_.remove_prefix (count);
    return bytes;
  }

  std::size_t
  takeByte ()
  {
    return static_cast<unsigned char> (take (1)[0]);
  }

private:
  std::string_view data_;
};

} // namespace

std::unique_ptr<char[]>
unpackLzf (std::string_view data, std::size_t size)
{
  // A first byte below this is that of a run of as many bytes as they are, and one
  // more; else its upper three bits tell how many bytes are as those before, how far
  // before its lower five and a byte.
  constexpr std::size_t REFERENCES_FROM = 32;
  constexpr std::size_t LONGEST_IN_FIRST = 7;
  PackedBytes packed (data);
  // Not filled with zeros first.
  std::unique_ptr<char[]> unpacked (new char[size]);
  std::size_t place = 0;
  const auto checkRoom = [&] (std::size_t count) {
    if (count > size - place)
      throw ReadError ("its compressed data hold more than the " +
                       std::to_string (size) + " bytes of its points");
  };
  while (!packed.isEmpty()) {
    const std::size_t first = packed.takeByte();
    if (first < REFERENCES_FROM) {
      const std::string_view run = packed.take (first + 1);
      checkRoom (run.size());
      std::memcpy (unpacked.get() + place, run.data(), run.size());
      place += run.size();
      continue;
    }
    std::size_t count = first / REFERENCES_FROM;
    if (count == LONGEST_IN_FIRST)
      count += packed.takeByte();
    count += 2;
    const std::size_t back = (first % REFERENCES_FROM << 8U) + packed.takeByte() + 1;
    if (back > place)
      throw ReadError ("its compressed data refer to bytes before their first");
    checkRoom (count);
    char* const to = unpacked.get() + place;
    if (back >= count)
      std::memcpy (to, to - back, count);
    else
      // Of few bytes that repeat, as what was just written is read again.
      for (std::size_t i = 0; i < count; ++i)
        to[i] =
            to[static_cast<std::ptrdiff_t> (i) - static_cast<std::ptrdiff_t> (back)];
    place += count;
  }
  if (place != size)
    throw ReadError ("its compressed data hold " + std::to_string (place) +
                     " bytes, but its points take " + std::to_string (size));
  return unpacked;
}

} // namespace crest
} // namespace pcl
