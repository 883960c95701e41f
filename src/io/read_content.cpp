// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_content.h"

#include <boost/algorithm/string/join.hpp>

#include "io/file_fields.h"
#include "io/gzip.h"
#include "io/output_file.h"
#include "io/text_columns.h"
#include "io/unread_formats.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace pcl {
namespace crest {

namespace {

struct Source {
  const std::string& text;
  const ReadOptions& options;
};

/** \brief A format by the extension of its files, and its reader. */
struct Format {
  const char* name;
  FileContent (*read) (const Source& source);
};

FileContent
readTextOf (const Source& source)
{
  return readXyz (source.text, source.options.columns);
}

FileContent
readLasOf (const Source& source)
{
  return readLas (source.text, source.options.classes);
}

constexpr Format FORMATS[] = {
    {"pcd", [] (const Source& source) { return readPcd (source.text); }},
    {"ply", [] (const Source& source) { return readPly (source.text); }},
    {"obj", [] (const Source& source) { return readObj (source.text); }},
    {"off", [] (const Source& source) { return readOff (source.text); }},
    {"stl", [] (const Source& source) { return readStl (source.text); }},
    {"vtk", [] (const Source& source) { return readVtk (source.text); }},
    {"vtp", [] (const Source& source) { return readVtp (source.text); }},
    {"las", readLasOf},
    {"xyz", readTextOf},
    {"txt", readTextOf},
    {"csv", readTextOf},
    {"asc", readTextOf},
    {"pts", readTextOf},
    {"neu", readTextOf},
    {"ptx", [] (const Source& source) { return readPtx (source.text); }},
};

const Format*
formatOf (const std::string& name)
{
  const auto* const format =
      std::find_if (std::begin (FORMATS),
                    std::end (FORMATS),
                    [&name] (const Format& f) { return name == f.name; });
  return format == std::end (FORMATS) ? nullptr : format;
}

std::ifstream
openFile (const std::filesystem::path& path)
{
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status (path, failure);
  if (!std::filesystem::exists (status))
    throw ReadError (status.type() == std::filesystem::file_type::not_found
                         ? "there is no such file"
                         : failure.message());
  if (std::filesystem::is_directory (status))
    throw ReadError ("it is a directory, but a file is needed");
  if (!std::filesystem::is_regular_file (status))
    throw ReadError ("it is not a regular file");
  std::ifstream stream (path, std::ios::binary);
  if (!stream)
    throw ReadError (std::string ("it cannot be opened: ") + std::strerror (errno));
  return stream;
}

std::string
readText (const std::string& file)
{
  const std::filesystem::path path (file);
  std::ifstream stream = openFile (path);
  // Through a small buffer, as a string of this size would first be filled with zeros.
  constexpr std::size_t BUFFER = 1U << 18U;
  std::vector<char> buffer (BUFFER);
  std::string text;
  text.reserve (std::filesystem::file_size (path));
  do {
    stream.read (buffer.data(), BUFFER);
    text.append (buffer.data(), static_cast<std::size_t> (stream.gcount()));
  }
  while (stream);
  if (!stream.eof())
    throw ReadError (std::string ("it cannot be read: ") + std::strerror (errno));
  return text;
}

} // namespace

FileContent
readContent (const std::string& file, const ReadOptions& options)
{
  return parseContent (file, readText (file), options);
}

FileContent
parseContent (const std::string& file, std::string text, const ReadOptions& options)
{
  std::string extension = extensionOf (file);
  if (extension == ".gz")
    extension = extensionOf (std::filesystem::path (file).stem().string());
  if (isGzip (text))
    text = unpackGzip (text);
  if (text.empty())
    throw ReadError ("it is empty");
  const std::string unread = explainUnread (file, extension, text);
  if (!unread.empty())
    throw ReadError (unread);
  const Format* const format =
      formatOf (!options.format.empty() || extension.empty() ? options.format
                                                             : extension.substr (1));
  if (format == nullptr)
    throw ReadError ("the extension \"" + extension + "\" is none of ." +
                     boost::join (readFormats(), ", .") + ": -format tells the format");
  if (!options.columns.empty() && format->read != readTextOf)
    throw ReadError ("it is no text whose columns -columns could tell: " +
                     std::string (format->name) + " files name them");
  if (!options.classes.empty() && format->read != readLasOf)
    throw ReadError ("it has no classes that -class could pick: LAS files have, but " +
                     std::string (format->name) + " files do not");
  FileContent content = format->read ({text, options});
  if (content.points.size() == 0)
    throw ReadError ("it has no points");
  checkPointCount (content.points.size());
  const std::string renamed = renameFields (content.fields);
  if (!renamed.empty())
    content.notes.push_back (renamed);
  return content;
}

bool
checkReadable (const std::string& file, std::string& error)
{
  try {
    openFile (file);
    return true;
  }
  catch (const ReadError& problem) {
    error = file + ": " + problem.what();
  }
  return false;
}

std::vector<std::string>
readFormats ()
{
  std::vector<std::string> names;
  for (const Format& format : FORMATS)
    names.emplace_back (format.name);
  return names;
}

std::string
explainInvalid (const ReadOptions& options)
{
  if (!options.format.empty() && formatOf (options.format) == nullptr)
    return "the format \"" + options.format + "\" is none of " +
           boost::join (readFormats(), ", ");
  if (!(options.sample_spacing >= 0.0) || std::isinf (options.sample_spacing))
    return "the spacing of samples must be a number above 0, or 0 for none";
  return options.columns.empty() ? std::string()
                                 : explainInvalidColumns (options.columns);
}

} // namespace crest
} // namespace pcl
