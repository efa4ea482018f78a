// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/byte_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pitwall::traffic {
namespace {

std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(BytePool, SpansStayValidWhereverThePoolGoes) {
  BytePool pool;
  std::vector<std::pair<Bytes, std::string>> kept;
  for (std::size_t i = 0; i < 3'000; ++i) {
    const std::string text(i % 1'500, static_cast<char>('a' + i % 26));
    kept.emplace_back(i % 100 == 99 ? pool.adopt(text) : pool.copy(as_bytes(text)), text);
  }
  BytePool moved = std::move(pool);
  BytePool other;
  kept.emplace_back(other.copy(as_bytes("of the other")), "of the other");
  other.absorb(std::move(moved));
  kept.emplace_back(other.copy(as_bytes("behind")), "behind");
  for (const auto& [bytes, text] : kept) EXPECT_EQ(text_of(bytes), text);
}

TEST(BytePool, ALargeCopyGetsABlockOfItsOwn) {
  BytePool pool;
  const Bytes small = pool.copy(as_bytes("small"));
  const std::string large((std::size_t{1} << 20) + 1, 'x');
  const Bytes copy = pool.copy(as_bytes(large));
  EXPECT_EQ(text_of(small), "small");
  EXPECT_EQ(text_of(copy), large);
}

}  // namespace
}  // namespace pitwall::traffic
