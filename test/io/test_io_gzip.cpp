// SPDX-License-Identifier: BSD-3-Clause
// Files packed by zlib's own writer are read as if they were not packed.
#include <pcl_crest/io/read_cloud.h>

#include <gtest/gtest.h>

#include "support/temporary_directory.h"
#include <zlib.h>

#include <fstream>

using namespace pcl::crest;

namespace {

class IoGzip : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;
  std::string text_;

  void
  SetUp () override
  {
    for (int i = 0; i < 5000; ++i)
      text_ += std::to_string (i % 71) + " " + std::to_string (i / 71) + " " +
               std::to_string (i * i % 13) + "\n";
  }

  std::string
  packed (const std::string& text) const
  {
    const std::string file = directory_.file ("packed");
    gzFile packer = gzopen (file.c_str(), "wb");
    gzwrite (packer, text.data(), static_cast<unsigned> (text.size()));
    gzclose (packer);
    std::ifstream stream (file, std::ios::binary);
    return {std::istreambuf_iterator<char> (stream), {}};
  }

  std::string
  refusal (const std::string& content) const
  {
    InputCloud cloud;
    std::string error;
    const std::string file = directory_.file ("bad.xyz.gz", content);
    EXPECT_FALSE (readCloud (file, 12, 1, cloud, error));
    return error.substr (std::min (file.size(), error.size()));
  }
};

TEST_F (IoGzip, IsReadAsIfItWereNotPacked)
{
  InputCloud plain;
  std::string error;
  ASSERT_TRUE (readCloud (directory_.file ("a.xyz", text_), 12, 1, plain, error));
  const std::size_t half = text_.find ('\n', text_.size() / 2) + 1;
  for (const std::string& content :
       {packed (text_), packed (text_.substr (0, half)) + packed (text_.substr (half))})
    for (const std::string name : {"b.xyz.gz", "b.XYZ.GZ", "b.xyz"}) {
      InputCloud cloud;
      ASSERT_TRUE (readCloud (directory_.file (name, content), 12, 1, cloud, error))
          << error;
      ASSERT_EQ (plain.points->size(), cloud.points->size());
      for (std::size_t i = 0; i < plain.points->size(); ++i)
        ASSERT_EQ ((*plain.points)[i].getVector3fMap(),
                   (*cloud.points)[i].getVector3fMap());
    }
}

TEST_F (IoGzip, WhatIsCutOrDamagedIsRefused)
{
  const std::string content = packed (text_);
  for (std::size_t size = 3; size < content.size(); size += 97)
    EXPECT_EQ (": its gzip data end too early: it is cut off",
               refusal (content.substr (0, size)));
  std::string damaged = content;
  damaged[damaged.size() - 6] ^= 1;
  EXPECT_EQ (0U, refusal (damaged).find (": its gzip data are damaged near byte "));
  EXPECT_EQ (": behind its gzip data there are 3 other bytes",
             refusal (content + "abc"));
  EXPECT_EQ (": it is empty", refusal (packed ("")));
}

} // namespace
