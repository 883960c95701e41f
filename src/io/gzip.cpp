// SPDX-License-Identifier: BSD-3-Clause
#include "io/gzip.h"

#include "io/text_scanner.h"
#define ZLIB_CONST // input is const
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>

namespace pcl {
namespace crest {

namespace {

constexpr std::string_view MAGIC = "\x1F\x8B\x08";

} // namespace

bool
isGzip (const std::string& content)
{
  return content.compare (0, MAGIC.size(), MAGIC) == 0;
}

std::string
unpackGzip (const std::string& content)
{
  constexpr int WITH_GZIP_HEADER = 15 + 16;
  z_stream stream{};
  if (inflateInit2 (&stream, WITH_GZIP_HEADER) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype (&inflateEnd)> guard (&stream, &inflateEnd);

  std::string unpacked;
  std::size_t used = 0;
  std::size_t filled = 0;
  // zlib counts in unsigned int. What a file announces is not trusted: the room grows
  // with what comes out.
  const auto atMost = [] (std::size_t bytes) {
    return static_cast<uInt> (
        std::min<std::size_t> (bytes, std::numeric_limits<uInt>::max()));
  };
  while (true) {
    if (filled == unpacked.size())
      unpacked.resize (std::max (2 * filled, 4 * content.size()));
    stream.next_in = reinterpret_cast<const Bytef*> (content.data() + used);
    stream.avail_in = atMost (content.size() - used);
    stream.next_out = reinterpret_cast<Bytef*> (unpacked.data() + filled);
    stream.avail_out = atMost (unpacked.size() - filled);
    const uInt in_before = stream.avail_in;
    const uInt out_before = stream.avail_out;
    const int result = inflate (&stream, Z_NO_FLUSH);
    used += in_before - stream.avail_in;
    filled += out_before - stream.avail_out;
    if (result == Z_STREAM_END) {
      if (used == content.size())
        break;
      // Files of gzip may be appended to each other.
      if (content.compare (used, MAGIC.size(), MAGIC) != 0)
        throw ReadError ("behind its gzip data there are " +
                         std::to_string (content.size() - used) + " other bytes");
      inflateReset (&stream);
    }
    else if (result == Z_MEM_ERROR)
      throw std::bad_alloc();
    else if (result != Z_OK && result != Z_BUF_ERROR)
      throw ReadError ("its gzip data are damaged near byte " + std::to_string (used));
    else if (used == content.size() && filled < unpacked.size())
      throw ReadError ("its gzip data end too early: it is cut off");
  }
  unpacked.resize (filled);
  return unpacked;
}

} // namespace crest
} // namespace pcl
