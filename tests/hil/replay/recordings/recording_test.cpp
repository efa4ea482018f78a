// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/recording.hpp"

#include <gtest/gtest.h>

#include <set>

namespace pitwall::traffic {
namespace {

Record at(std::int64_t ns, std::uint32_t source, std::uint64_t sequence) {
  return {UtcTime{ns}, source, sequence, Bytes{}};
}

TEST(Recording, TheOrderIsStampThenSourceThenSequence) {
  EXPECT_TRUE(precedes(at(1, 9, 9), at(2, 0, 0)));
  EXPECT_TRUE(precedes(at(1, 0, 9), at(1, 1, 0)));
  EXPECT_TRUE(precedes(at(1, 1, 0), at(1, 1, 1)));
  EXPECT_FALSE(precedes(at(1, 1, 1), at(1, 1, 1)));
}

TEST(Recording, ARecordHoldsAFrameOrBytes) {
  const can::Frame frame{.id = 7, .length = 1};
  const Record of_can{UtcTime{}, 0, 0, frame};
  EXPECT_EQ(*of_can.frame(), frame);
  EXPECT_TRUE(of_can.bytes().empty());
  const Record of_bytes{UtcTime{}, 0, 0, as_bytes("ab")};
  EXPECT_EQ(of_bytes.frame(), nullptr);
  EXPECT_EQ(of_bytes.bytes().size(), 2U);
}

TEST(Recording, ARemarkSaysWhereWhatAndHowOften) {
  EXPECT_EQ(to_string(Remark{"a.mcap: byte 7", "cut"}), "a.mcap: byte 7: cut");
  EXPECT_EQ(to_string(Remark{"a.mcap: byte 7", "cut", 3}),
            "a.mcap: byte 7: cut (3 times, first here)");
}

TEST(Recording, EveryKindHasAName) {
  std::set<std::string_view> names;
  for (const SourceKind kind :
       {SourceKind::kCan, SourceKind::kReceiver, SourceKind::kRos, SourceKind::kOther})
    names.insert(to_string(kind));
  EXPECT_EQ(names.size(), 4U);
  EXPECT_FALSE(names.contains("?"));
}

}  // namespace
}  // namespace pitwall::traffic
