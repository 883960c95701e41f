// SPDX-License-Identifier: BSD-3-Clause
#include "io/unpack_blocks.h"

#include "io/number_type.h"
#include "io/text_scanner.h"
#define ZLIB_CONST // input is const
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace pcl {
namespace crest {

namespace {

/** \brief What zlib makes at most of a byte. */
constexpr std::size_t BEST_RATIO = 1032;

[[noreturn]] void
failCut (const std::string& what)
{
  throw ReadError ("the array of its " + what + " is cut off");
}

/** \brief Bytes as they are. */
class RawBytes {
public:
  explicit RawBytes (std::string_view data) : data_ (data) {}

  std::size_t
  most () const
  {
    return data_.size();
  }

  std::string
  take (std::size_t size, const std::string& what)
  {
    if (size > data_.size())
      failCut (what);
    std::string bytes (data_.substr (0, size));
    data_.remove_prefix (size);
    return bytes;
  }

  /** \brief Of base64 the sizes of compressed blocks are encoded by themselves. */
  void
  endPart ()
  {}

private:
  std::string_view data_;
};

/** \brief Bytes in base64 (RFC 4648). */
class Base64Bytes {
public:
  explicit Base64Bytes (std::string_view data) : data_ (data) { skipBlanks(); }

  std::size_t
  most () const
  {
    return data_.size() / 4 * 3 + rest_.size();
  }

  std::string
  take (std::size_t size, const std::string& what)
  {
    if (size > most())
      failCut (what);
    while (rest_.size() < size)
      decodeGroup (what);
    std::string bytes = rest_.substr (0, size);
    rest_.erase (0, size);
    return bytes;
  }

  void
  endPart ()
  {
    rest_.clear();
  }

private:
  void
  skipBlanks ()
  {
    while (!data_.empty() &&
           (isBlank (data_.front()) || data_.front() == '\n' || data_.front() == '\r'))
      data_.remove_prefix (1);
  }

  static unsigned
  valueOf (char c, const std::string& what)
  {
    const bool is_upper = c >= 'A' && c <= 'Z';
    const bool is_lower = c >= 'a' && c <= 'z';
    const bool is_digit = c >= '0' && c <= '9';
    const int value = is_upper   ? c - 'A'
                      : is_lower ? c - 'a' + 26
                      : is_digit ? c - '0' + 52
                      : c == '+' ? 62
                      : c == '/' ? 63
                                 : -1;
    if (value < 0)
      throw ReadError ("the array of its " + what + " is no base64: it has \"" +
                       TextScanner::shown (std::string_view (&c, 1)) + "\"");
    return static_cast<unsigned> (value);
  }

  void
  decodeGroup (const std::string& what)
  {
    if (data_.size() < 4)
      failCut (what);
    unsigned bits = 0;
    std::size_t bytes = 3;
    for (std::size_t i = 0; i < 4; ++i) {
      const bool is_padding = i >= 2 && data_[i] == '=';
      bytes -= is_padding ? 1 : 0;
      bits = bits << 6U | (is_padding ? 0U : valueOf (data_[i], what));
    }
    if (bytes < 3 && data_[3] != '=')
      failCut (what);
    for (std::size_t i = 0; i < bytes; ++i)
      rest_ += static_cast<char> (bits >> (16U - 8U * i));
    data_.remove_prefix (4);
  }

  std::string_view data_;
  /** decoded, and not taken */
  std::string rest_;
};

template <typename Bytes>
std::size_t
takeSize (Bytes& bytes, const BlockEncoding& encoding, const std::string& what)
{
  const std::string number = bytes.take (encoding.wide_sizes ? 8 : 4, what);
  return encoding.wide_sizes
             ? decodeAs<std::uint64_t> (number.data(), encoding.big_endian)
             : decodeAs<std::uint32_t> (number.data(), encoding.big_endian);
}

void
checkSize (std::size_t found, std::size_t size, const std::string& what)
{
  if (found != size)
    throw ReadError ("the array of its " + what + " has " + std::to_string (found) +
                     " bytes, but those announced take " + std::to_string (size));
}

template <typename Bytes>
std::string
unpackBlocks (Bytes bytes,
              std::size_t size,
              const BlockEncoding& encoding,
              const std::string& what)
{
  const std::size_t blocks = takeSize (bytes, encoding, what);
  const std::size_t block_size = takeSize (bytes, encoding, what);
  const std::size_t last_size = takeSize (bytes, encoding, what);
  // Of arrays that are smaller than a block there is a part of one.
  if (blocks > bytes.most() || last_size > size)
    checkSize (std::max (blocks, last_size), size, what);
  const std::size_t whole = last_size == 0 ? blocks : blocks - (blocks == 0 ? 0 : 1);
  if (block_size != 0 && whole > size / block_size)
    checkSize (whole * block_size, size, what);
  checkSize (whole * block_size + (blocks == 0 ? 0 : last_size), size, what);
  if (size / BEST_RATIO > bytes.most())
    failCut (what);
  std::vector<std::size_t> packed;
  for (std::size_t i = 0; i < blocks; ++i)
    packed.push_back (takeSize (bytes, encoding, what));
  bytes.endPart();
  std::string unpacked (size, '\0');
  std::size_t place = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::string block = bytes.take (packed[i], what);
    const std::size_t expected = i < whole ? block_size : last_size;
    auto found = static_cast<uLongf> (expected);
    if (uncompress (reinterpret_cast<Bytef*> (unpacked.data() + place),
                    &found,
                    reinterpret_cast<const Bytef*> (block.data()),
                    static_cast<uLong> (block.size())) != Z_OK ||
        found != expected)
      throw ReadError ("block " + std::to_string (i + 1) + " of the array of its " +
                       what + " is damaged");
    place += expected;
  }
  return unpacked;
}

template <typename Bytes>
std::string
unpack (Bytes bytes,
        std::size_t size,
        const BlockEncoding& encoding,
        const std::string& what)
{
  if (encoding.compressed)
    return unpackBlocks (std::move (bytes), size, encoding, what);
  checkSize (takeSize (bytes, encoding, what), size, what);
  return bytes.take (size, what);
}

} // namespace

std::string
unpackRaw (std::string_view data,
           std::size_t size,
           const BlockEncoding& encoding,
           const std::string& what)
{
  return unpack (RawBytes (data), size, encoding, what);
}

std::string
unpackBase64 (std::string_view data,
              std::size_t size,
              const BlockEncoding& encoding,
              const std::string& what)
{
  return unpack (Base64Bytes (data), size, encoding, what);
}

} // namespace crest
} // namespace pcl
