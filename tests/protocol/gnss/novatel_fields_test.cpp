// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_fields.hpp"

#include <gtest/gtest.h>

#include <set>

#include "protocol/gnss/novatel_names.hpp"
#include "tests/protocol/gnss/random_messages.hpp"

namespace pitwall::gnss {
namespace {

struct Measurer {
  std::size_t bytes = 0;

  template <class... Field>
  void operator()(Kind, const Field&... field) {
    bytes += (sizeof(field) + ...);
  }
};

TEST(NovatelFields, TheFieldsOfALogAreAsLongAsTheLog) {
  for (std::size_t i = 0; i < kLogs; ++i) {
    std::visit(
        [](auto m) {
          if constexpr (std::is_same_v<decltype(m), InsConfig>)
            m.translations = m.rotations = kMostEntries;
          Measurer measurer;
          visit_fields(m, measurer);
          EXPECT_EQ(measurer.bytes, m.kBytes) << m.kId;
        },
        empty_message(i));
  }
}

TEST(NovatelFields, EveryLogHasItsNumberAndItsName) {
  std::set<std::uint16_t> ids;
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kLogs; ++i) {
    const auto id = std::visit([](const auto& m) { return m.kId; }, empty_message(i));
    ids.insert(id);
    names.insert(log_name(id));
    ASSERT_TRUE(message_of(id).has_value());
    EXPECT_EQ(message_of(id)->index(), i);
    EXPECT_EQ(log_id(log_name(id)), id);
  }
  EXPECT_EQ(ids.size(), kLogs);
  EXPECT_EQ(names.size(), kLogs);
  EXPECT_FALSE(names.contains(""));
  EXPECT_FALSE(message_of(1163).has_value());  // PSRDOP2
  EXPECT_FALSE(message_of(0).has_value());     // what an unknown name becomes
}

}  // namespace
}  // namespace pitwall::gnss
