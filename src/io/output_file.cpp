// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>

namespace pcl {
namespace crest {

namespace {

namespace fs = std::filesystem;

/** \brief The names of files that a signal has to remove, where its handler may read
 * them. Names that find no place stay behind.
 */
struct UnfinishedFile {
  std::atomic<bool> taken;
  std::atomic<bool> exists;
  std::array<char, PATH_MAX> path;
};
std::array<UnfinishedFile, 16> unfinished_files;
/** how many threads put files in their places, which a signal waits for */
std::atomic<int> placing{0};
std::atomic<int> waiting_signal{0};

/** \brief Of a file that exists under a name for a while. */
class UnfinishedName {
public:
  explicit UnfinishedName (const fs::path& path)
  {
    if (path.native().size() >= PATH_MAX)
      return;
    for (UnfinishedFile& file : unfinished_files)
      if (!file.taken.exchange (true)) {
        path.native().copy (file.path.data(), PATH_MAX);
        file.path[path.native().size()] = '\0';
        file.exists = true;
        file_ = &file;
        return;
      }
  }
  UnfinishedName (const UnfinishedName&) = delete;
  UnfinishedName&
  operator= (const UnfinishedName&) = delete;
  ~UnfinishedName()
  {
    if (file_ == nullptr)
      return;
    file_->exists = false;
    file_->taken = false;
  }

private:
  UnfinishedFile* file_ = nullptr;
};

extern "C" void
removeUnfinishedFiles (int signal)
{
  if (placing != 0) {
    waiting_signal = signal;
    return;
  }
  for (const UnfinishedFile& file : unfinished_files)
    if (file.exists)
      ::unlink (file.path.data());
  // Ends the program as if there were no handler, once this one returns.
  std::signal (signal, SIG_DFL);
  std::raise (signal);
}

/** \brief Lets no signal end the program between the first file and the last. */
class Placing {
public:
  Placing() { ++placing; }
  Placing (const Placing&) = delete;
  Placing&
  operator= (const Placing&) = delete;
  ~Placing()
  {
    --placing;
    if (const int signal = waiting_signal.exchange (0); signal != 0)
      std::raise (signal);
  }
};

/** \brief A name in a folder that no other file has, or is likely to get. */
fs::path
newName (const fs::path& folder)
{
  constexpr char DIGITS[] = "0123456789abcdefghijklmnopqrstuv";
  std::random_device random;
  std::string name = ".pcl_crest_";
  for (int i = 0; i < 16; ++i)
    name += DIGITS[random() % 32U];
  return folder / (name + ".part");
}

/** \brief A file beside its target, which is gone again unless it takes its place. */
class Draft {
public:
  /** \brief Creates it; check failure (). */
  explicit Draft (const std::string& file) : name_ (file)
  {
    std::error_code code;
    if (file.empty()) {
      failure_ = "it has no name";
      return;
    }
    target_ = fs::absolute (file, code);
    if (!code)
      target_ = fs::weakly_canonical (target_, code);
    if (code)
      failure_ = code.message();
    else if (fs::is_symlink (fs::symlink_status (target_, code)))
      failure_ = "it is a symbolic link to " +
                 fs::read_symlink (target_, code).string() + ", which does not exist";
    else if (const fs::file_status status = fs::status (target_, code);
             fs::is_directory (status))
      failure_ = "it is a directory";
    else if (fs::exists (status) && !fs::is_regular_file (status))
      failure_ = "it is not a regular file";
    else if (fs::exists (status) && ::access (target_.c_str(), W_OK) != 0)
      failure_ = std::strerror (errno);
    else
      create();
  }
  Draft (const Draft&) = delete;
  Draft&
  operator= (const Draft&) = delete;
  ~Draft()
  {
    close();
    if (exists_)
      ::unlink (path_.c_str());
    if (!backup_.empty())
      ::unlink (backup_.c_str());
  }

  /** \brief Writes it, but leaves the target as it is; check failure (). */
  void
  write (const std::string& content)
  {
    std::size_t written = 0;
    while (failure_.empty() && written < content.size()) {
      const ::ssize_t count =
          ::write (descriptor_, content.data() + written, content.size() - written);
      if (count >= 0)
        written += static_cast<std::size_t> (count);
      else if (errno != EINTR)
        failure_ = std::strerror (errno);
    }
    if (failure_.empty() && ::fsync (descriptor_) != 0)
      failure_ = std::strerror (errno);
    close();
  }

  /** \brief Keeps the file that is there under a second name; check failure (). */
  void
  backUp ()
  {
    if (!failure_.empty() || !fs::exists (target_))
      return;
    backup_ = newName (target_.parent_path());
    backup_name_ = std::make_unique<UnfinishedName> (backup_);
    // Where a disk knows no second names, files of a group can but be renamed in turn.
    if (::link (target_.c_str(), backup_.c_str()) != 0)
      backup_.clear();
  }

  /** \brief Puts what was written in the place of the target; check failure (). */
  void
  takePlace ()
  {
    if (!failure_.empty())
      return;
    // A file that was there keeps the permissions that its owner gave it.
    struct stat before {};
    was_there_ = ::stat (target_.c_str(), &before) == 0;
    if (::chmod (path_.c_str(), was_there_ ? before.st_mode & 07777U : newMode()) !=
            0 ||
        std::rename (path_.c_str(), target_.c_str()) != 0) {
      failure_ = std::strerror (errno);
      return;
    }
    exists_ = false;
    // So that the name, too, is on the disk; not all of them can do that.
    const int folder = ::open (target_.parent_path().c_str(), O_RDONLY | O_CLOEXEC);
    if (folder >= 0) {
      ::fsync (folder);
      ::close (folder);
    }
  }

  /** \brief After takePlace, has the target as it was before. */
  void
  giveBack ()
  {
    if (!backup_.empty() && std::rename (backup_.c_str(), target_.c_str()) == 0)
      backup_.clear();
    else if (!was_there_)
      ::unlink (target_.c_str());
  }

  const std::string&
  name () const
  {
    return name_;
  }

  const std::string&
  failure () const
  {
    return failure_;
  }

private:
  void
  create ()
  {
    do {
      path_ = newName (target_.parent_path());
      // Before there is the file, so that no signal comes in between.
      path_name_ = std::make_unique<UnfinishedName> (path_);
      descriptor_ = ::open (path_.c_str(),
                            O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW,
                            S_IRUSR | S_IWUSR);
    }
    while (descriptor_ < 0 && errno == EEXIST);
    exists_ = descriptor_ >= 0;
    if (!exists_)
      failure_ = std::strerror (errno);
  }

  void
  close ()
  {
    if (descriptor_ >= 0 && ::close (descriptor_) != 0 && failure_.empty())
      failure_ = std::strerror (errno);
    descriptor_ = -1;
  }

  /** \brief The permissions that new files get. */
  static ::mode_t
  newMode ()
  {
    // There is no other way to ask; what others create meanwhile is for their owner.
    const ::mode_t mask = ::umask (077);
    ::umask (mask);
    return 0666U & ~mask;
  }

  std::string name_;
  fs::path target_;
  fs::path path_;
  std::unique_ptr<UnfinishedName> path_name_;
  /** the target as it was; empty if it was not there */
  fs::path backup_;
  std::unique_ptr<UnfinishedName> backup_name_;
  int descriptor_ = -1;
  /** whether the draft is there, not renamed */
  bool exists_ = false;
  bool was_there_ = false;
  std::string failure_;
};

bool
report (const std::string& file, const std::string& failure, std::string& error)
{
  if (!failure.empty())
    error = (file.empty() ? "\"\"" : file) + ": it cannot be written: " + failure;
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

struct OutputGroup::Drafts {
  std::vector<std::unique_ptr<Draft>> list;
};

namespace {

thread_local OutputGroup* current_group = nullptr;

} // namespace

OutputGroup::OutputGroup() : drafts_ (new Drafts) { current_group = this; }

OutputGroup::~OutputGroup() { current_group = nullptr; }

bool
OutputGroup::commit (std::string& error)
{
  const Placing guard;
  std::vector<std::unique_ptr<Draft>>& drafts = drafts_->list;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (drafts.size() > 1)
      drafts[i]->backUp();
    drafts[i]->takePlace();
    if (report (drafts[i]->name(), drafts[i]->failure(), error))
      continue;
    while (i-- > 0)
      drafts[i]->giveBack();
    drafts.clear();
    return false;
  }
  drafts.clear();
  return true;
}

bool
replaceFiles (const std::vector<OutputFile>& files, std::string& error)
{
  if (current_group == nullptr) {
    OutputGroup group;
    return replaceFiles (files, error) && group.commit (error);
  }
  for (const OutputFile& file : files) {
    auto draft = std::make_unique<Draft> (file.name);
    if (draft->failure().empty())
      draft->write (file.content);
    if (!report (file.name, draft->failure(), error))
      return false;
    current_group->drafts_->list.push_back (std::move (draft));
  }
  return true;
}

void
cleanUpOnSignals ()
{
  std::signal (SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    // What the program was started to ignore, as by nohup, it goes on to ignore.
    struct sigaction before {};
    ::sigaction (signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN)
      std::signal (signal, &removeUnfinishedFiles);
  }
}

bool
replaceFile (const std::string& file, const std::string& content, std::string& error)
{
  return replaceFiles ({{file, content}}, error);
}

} // namespace crest
} // namespace pcl
