// SPDX-License-Identifier: BSD-3-Clause
#include "load_pcd_module.h"

#include "text_scanner.h"

#ifdef PCL_CREST_PCD_MODULE
#include <dlfcn.h>

#include <filesystem>
#include <string>
#endif

namespace pcl {
namespace crest {

#ifdef PCL_CREST_PCD_MODULE

namespace {

PcdReader
load ()
{
  static const char of_this_library = 0;
  Dl_info here{};
  std::filesystem::path library_file;
  if (::dladdr (&of_this_library, &here) != 0)
    library_file = here.dli_fname;
  // Whatever name it was found by.
  std::error_code ignored;
  const std::filesystem::path resolved =
      std::filesystem::canonical (library_file, ignored);
  const std::string module = (resolved.parent_path() / PCL_CREST_PCD_MODULE).string();
  // Never closed: libraries of the module do not unload safely.
  void* const library = ::dlopen (module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const reader =
      library != nullptr ? ::dlsym (library, "pcl_crest_read_pcd") : nullptr;
  if (reader == nullptr)
    throw ReadError (
        std::string ("PCL's reader of PCD files could not be loaded from ") + module +
        ": " + ::dlerror());
  return reinterpret_cast<PcdReader> (reader);
}

} // namespace

PcdReader
loadPcdModule ()
{
  static const PcdReader reader = load();
  return reader;
}

#else

PcdReader
loadPcdModule ()
{
  return &pcl_crest_read_pcd;
}

#endif

} // namespace crest
} // namespace pcl
