// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/npy.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "protocol/transport/file.hpp"
#include "tests/support/oracle_node.hpp"

namespace pitwall::scenes {
namespace {

template <class T>
std::string text_of(const std::vector<T>& values, std::size_t columns) {
  return npy_text(std::span<const T>(values), columns);
}

class Npy : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = folder_->path() + "/" + name;
    EXPECT_TRUE(transport::write_file(path, text));
    return path;
  }
  static std::string numpy(const std::string& code) {
    return testing::output_of("/usr/bin/python3 -c \"import numpy as np; " + code + "\" 2>&1");
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-npy-");
};

TEST_F(Npy, NumpyReadsWhatWasWritten) {
  const std::string table = file("table.npy", text_of<float>({0.5F, -2.0F, 3e8F, 4, 5, 6}, 3));
  EXPECT_EQ(numpy("a = np.load('" + table + "'); print(a.dtype, a.shape, a.tolist())"),
            "float32 (2, 3) [[0.5, -2.0, 300000000.0], [4.0, 5.0, 6.0]]\n");
  const std::string row = file("row.npy", text_of<std::uint32_t>({1, 4'294'967'295}, 1));
  EXPECT_EQ(numpy("a = np.load('" + row + "'); print(a.dtype, a.shape, a.tolist())"),
            "uint32 (2,) [1, 4294967295]\n");
  const std::string bytes = file("bytes.npy", text_of<std::uint8_t>({}, 10));
  EXPECT_EQ(numpy("a = np.load('" + bytes + "'); print(a.dtype, a.shape)"), "uint8 (0, 10)\n");
}

TEST_F(Npy, WhatNumpyWroteIsRead) {
  const std::string path = folder_->path() + "/of_numpy.npy";
  EXPECT_EQ(numpy("np.save('" + path + "', np.arange(40, dtype=np.float32).reshape(20, 2))"), "");
  const auto text = transport::read_file(path);
  ASSERT_TRUE(text);
  const auto values = read_npy<float>(*text, "of_numpy.npy", 2);
  ASSERT_TRUE(values) << to_string(values.error());
  ASSERT_EQ(values->size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ((*values)[i], static_cast<float>(i));
}

TEST_F(Npy, AnythingElseIsRefusedWithItsName) {
  const std::string good = text_of<float>({1, 2, 3, 4}, 2);
  ASSERT_TRUE(read_npy<float>(good, "good", 2));
  EXPECT_FALSE(read_npy<float>(good, "other columns", 1));
  EXPECT_FALSE(read_npy<std::uint32_t>(good, "other numbers", 2));
  EXPECT_FALSE(read_npy<float>(good + "....", "more than it says", 2));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(read_npy<float>(std::string_view{good}.substr(0, size), "cut", 2)) << size;
  const auto refused = read_npy<float>("no array", "there.npy", 2);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "there.npy");
}

}  // namespace
}  // namespace pitwall::scenes
