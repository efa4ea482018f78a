// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/field_kind.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "protocol/gnss/novatel_ascii.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "tests/protocol/gnss/random_messages.hpp"

namespace pitwall::gnss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(FieldKind, LimitsBelongToTheRange) {
  EXPECT_FALSE(check_field(Kind::kLatitude, 90.0));
  EXPECT_FALSE(check_field(Kind::kLatitude, -90.0));
  EXPECT_EQ(check_field(Kind::kLatitude, std::nextafter(90.0, 91.0)), DecodeError::kLatitude);
  EXPECT_FALSE(check_field(Kind::kLongitude, -180.0));
  EXPECT_EQ(check_field(Kind::kLongitude, 180.1), DecodeError::kLongitude);
  EXPECT_FALSE(check_field(Kind::kSigma, 0.0));
  EXPECT_EQ(check_field(Kind::kSigma, -1e-30), DecodeError::kNegativeDeviation);
  EXPECT_FALSE(check_field(Kind::kSeconds, 604'800.0));
  EXPECT_EQ(check_field(Kind::kSeconds, -0.001), DecodeError::kTimeOfWeek);
  EXPECT_FALSE(check_field(Kind::kNumber, -1e300));
  EXPECT_FALSE(check_field(Kind::kReserved, kUnset));
}

// One value that each kind of field cannot have, and why.
struct Spoiler {
  std::size_t at = 0;  // the how manieth number of the message
  double value = kUnset;
  std::optional<DecodeError> reason{};  // why it must be refused
  std::size_t numbers = 0;

  template <class... Field>
  void operator()(Kind kind, Field&... field) {
    (spoil(kind, field), ...);
  }

 private:
  template <class T>
  void spoil(Kind kind, T& field) {
    if constexpr (std::is_floating_point_v<T>) {
      if (kind == Kind::kReserved || numbers++ != at) return;
      field = static_cast<T>(value);
      reason = check_field(kind, value);
    }
  }
};

std::vector<Result<NovatelMessage, DecodeError>> received(const NovatelMessage& message) {
  std::array<std::uint8_t, kMaxAsciiBytes> bytes{};
  std::vector<Result<NovatelMessage, DecodeError>> results;
  NovatelStream stream;
  const auto take = [&](const NovatelFrame& frame) { results.push_back(decode(frame)); };
  stream.feed(std::span{bytes}.first(encode({}, message, bytes)), take);
  stream.feed(std::span{bytes}.first(encode_ascii({}, message, bytes)), take);
  return results;
}

// Every number of every log, spoilt in every way, binary and ASCII.
TEST(FieldKind, ANumberThatCannotBeIsRefusedWithItsReasonInEveryFieldOfEveryLog) {
  std::mt19937_64 random{5};
  Refusals refusals;
  std::uint64_t expected = 0;
  for (std::size_t i = 0; i < kLogs; ++i) {
    for (const double value : {kUnset, kInfinity, -kInfinity, -1.0, 91.0, -181.0, 1e6}) {
      for (Spoiler spoiler{.value = value}; spoiler.at <= spoiler.numbers; ++spoiler.at) {
        NovatelMessage message = random_message(i, random);
        spoiler.numbers = 0, spoiler.reason.reset();
        std::visit([&](auto& m) { visit_fields(m, spoiler); }, message);
        if (!spoiler.reason) continue;
        const auto results = received(message);
        ASSERT_EQ(results.size(), 2U);
        for (const auto& result : results) {
          ASSERT_FALSE(result.has_value()) << i << " number " << spoiler.at << " " << value;
          EXPECT_EQ(result.error(), *spoiler.reason);
          refusals.count(result.error());
        }
        expected += 2;
      }
    }
  }
  EXPECT_EQ(refusals.total(), expected);
  for (const DecodeError reason :
       {DecodeError::kNotFinite, DecodeError::kNegativeDeviation, DecodeError::kLatitude,
        DecodeError::kLongitude, DecodeError::kTimeOfWeek}) {
    EXPECT_GT(refusals.of(reason), 0U) << text(reason);
  }
}

TEST(FieldKind, EveryReasonHasAText) {
  for (std::size_t i = 0; i < kDecodeErrorText.size(); ++i) {
    EXPECT_GT(text(static_cast<DecodeError>(i)).size(), 10U);
  }
}

}  // namespace
}  // namespace pitwall::gnss
