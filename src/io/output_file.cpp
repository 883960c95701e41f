// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace pcl {
namespace crest {

namespace {

namespace fs = std::filesystem;

/** \brief A file beside its target, which is gone again unless it takes its place. */
class Draft {
public:
  /** \brief Creates it; check failure (). */
  explicit Draft (const std::string& file)
  {
    std::error_code code;
    target_ = fs::weakly_canonical (file, code);
    if (code)
      failure_ = code.message();
    else if (const fs::file_status status = fs::status (target_, code);
             fs::is_directory (status))
      failure_ = "it is a directory";
    else if (fs::exists (status) && !fs::is_regular_file (status))
      failure_ = "it is not a regular file";
    else if (fs::exists (status) && ::access (target_.c_str(), W_OK) != 0)
      failure_ = std::strerror (errno);
    else {
      path_ = target_;
      path_ += ".part-" + std::to_string (::getpid());
      stream_ = std::fopen (path_.c_str(), "wb");
      if (stream_ == nullptr)
        failure_ = std::strerror (errno);
    }
  }
  Draft (const Draft&) = delete;
  Draft&
  operator= (const Draft&) = delete;
  ~Draft()
  {
    if (stream_ != nullptr)
      std::fclose (stream_);
    if (stream_ != nullptr || written_)
      std::remove (path_.c_str());
  }

  /** \brief Writes it, but leaves the target as it is; check failure (). */
  void
  write (const std::string& content)
  {
    if (stream_ == nullptr)
      return;
    const bool good =
        std::fwrite (content.data(), 1, content.size(), stream_) == content.size() &&
        std::fflush (stream_) == 0;
    if (!good)
      failure_ = std::strerror (errno);
    std::FILE* const stream = stream_;
    stream_ = nullptr;
    written_ = true;
    if (std::fclose (stream) != 0 && good)
      failure_ = std::strerror (errno);
  }

  /** \brief Puts what was written in the place of the target; check failure (). */
  void
  takePlace ()
  {
    if (!failure_.empty())
      return;
    // A file that was there keeps the permissions that its owner gave it.
    std::error_code none;
    const fs::file_status before = fs::status (target_, none);
    if (fs::exists (before))
      fs::permissions (path_, before.permissions(), none);
    if (std::rename (path_.c_str(), target_.c_str()) != 0)
      failure_ = std::strerror (errno);
    else
      written_ = false;
  }

  const std::string&
  failure () const
  {
    return failure_;
  }

private:
  fs::path target_;
  fs::path path_;
  std::FILE* stream_ = nullptr;
  /** whether the draft is there, closed, and not renamed */
  bool written_ = false;
  std::string failure_;
};

bool
report (const std::string& file, const std::string& failure, std::string& error)
{
  if (!failure.empty())
    error = file + ": it cannot be written: " + failure;
  return failure.empty();
}

} // namespace

std::string
extensionOf (const std::string& file)
{
  std::string extension = fs::path (file).extension().string();
  std::transform (extension.begin(),
                  extension.end(),
                  extension.begin(),
                  [] (unsigned char c) { return std::tolower (c); });
  return extension;
}

bool
hasExtension (const std::string& file,
              const std::vector<std::string>& extensions,
              std::string& error)
{
  if (std::find (extensions.begin(), extensions.end(), extensionOf (file)) !=
      extensions.end())
    return true;
  error = file + ": the extension must be ";
  for (std::size_t i = 0; i < extensions.size(); ++i)
    error += (i == 0 ? "" : i + 1 == extensions.size() ? " or " : ", ") + extensions[i];
  return false;
}

bool
checkWritable (const std::string& file, std::string& error)
{
  return report (file, Draft (file).failure(), error);
}

bool
replaceFiles (const std::vector<OutputFile>& files, std::string& error)
{
  std::vector<std::unique_ptr<Draft>> drafts;
  for (const OutputFile& file : files) {
    drafts.push_back (std::make_unique<Draft> (file.name));
    drafts.back()->write (file.content);
    if (!report (file.name, drafts.back()->failure(), error))
      return false;
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    drafts[i]->takePlace();
    if (!report (files[i].name, drafts[i]->failure(), error))
      return false;
  }
  return true;
}

bool
replaceFile (const std::string& file, const std::string& content, std::string& error)
{
  return replaceFiles ({{file, content}}, error);
}

} // namespace crest
} // namespace pcl
