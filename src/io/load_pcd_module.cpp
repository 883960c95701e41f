// SPDX-License-Identifier: BSD-3-Clause
#include "io/load_pcd_module.h"

#include "io/text_scanner.h"

#ifdef PCL_CREST_MODULE_PREFIX
#include <dlfcn.h>

#include <filesystem>
#include <string>
#endif

namespace pcl {
namespace crest {

#ifdef PCL_CREST_MODULE_PREFIX

namespace {

LzfDecoder
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
  const std::string module =
      (resolved.parent_path() / (std::string (PCL_CREST_MODULE_PREFIX) +
                                 "pcl_crest_pcd" + PCL_CREST_MODULE_SUFFIX))
          .string();
  // Never closed: libraries of the module do not unload safely.
  void* const library = ::dlopen (module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function =
      library != nullptr ? ::dlsym (library, "pcl_crest_decode_lzf") : nullptr;
  if (function == nullptr)
    throw ReadError ("PCL's part in reading it could not be loaded from " + module +
                     ": " + ::dlerror());
  return reinterpret_cast<LzfDecoder> (function);
}

} // namespace

LzfDecoder
loadLzf ()
{
  static const LzfDecoder decoder = load();
  return decoder;
}

#else

LzfDecoder
loadLzf ()
{
  return &pcl_crest_decode_lzf;
}

#endif

} // namespace crest
} // namespace pcl
