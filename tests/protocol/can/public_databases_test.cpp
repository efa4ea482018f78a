// Public databases, read where they lie: those of the car's buses and the corner cases of cantools.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

void expect_read(const std::filesystem::path& path) {
  const auto parsed = parse_dbc(text_of(path), path.filename().string());
  if (path.stem() == "bad_message_length") {
    EXPECT_EQ(to_string(parsed.error()),
              "bad_message_length.dbc:40:6: error: signal Signal1 lies outside the 1 bytes of "
              "message Message1");
  } else if (path.stem() == "issue_199") {
    EXPECT_EQ(to_string(parsed.error()),
              "issue_199.dbc:45:1: error: id 274923520 of message DriverDoorStatus is too large "
              "for 11 bits (and 10 more)");
  } else {
    EXPECT_TRUE(parsed) << to_string(parsed.error());
  }
}

// Every bad item is named, and nothing else is lost.
void expect_read_leniently(const std::filesystem::path& path) {
  const Database d = leniently(text_of(path), path.filename().string());
  std::size_t left_out = 0;
  for (const Finding& f : d.findings) left_out += f.outcome.ends_with("left out") ? 1U : 0U;
  if (path.stem() == "bad_message_length") {
    EXPECT_EQ(errors_of(d),
              "bad_message_length.dbc:40:6: signal Signal1 lies outside the 1 bytes of message "
              "Message1; the signal is left out\n");
    EXPECT_EQ(signals_of(d), 0U);
    ASSERT_EQ(d.messages.size(), 1U);
    EXPECT_EQ(d.messages[0].flaws.size(), 1U);
  } else if (path.stem() == "issue_199") {
    EXPECT_EQ(d.messages.size(), 11U);
    EXPECT_EQ(signals_of(d), 25U);
    EXPECT_EQ(d.count(FindingSeverity::kError), 11U);
    for (const Message& m : d.messages) EXPECT_TRUE(m.extended && m.flaws.size() == 1U) << m.name;
    EXPECT_NE(
        errors_of(d).find("id 274923520 of message DriverDoorStatus is too large for 11 bits; "
                          "it is read as one of 29 bits\n"),
        std::string::npos);
  } else {
    EXPECT_EQ(errors_of(d), "") << path;
    EXPECT_EQ(left_out, 0U) << path;
    EXPECT_EQ(fingerprint(d), fingerprint(load(path))) << path;
  }
}

// Where the fingerprints differ, this names the message and the signal.
void expect_equal(const Database& ours, const Database& theirs) {
  ASSERT_EQ(ours.messages.size(), theirs.messages.size());
  for (std::size_t i = 0; i < ours.messages.size(); ++i) {
    const Message &a = ours.messages[i], &b = theirs.messages[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.length, b.length);
    EXPECT_EQ(a.signals.size(), b.signals.size()) << a.name;
    for (const Signal& s : b.signals) {
      const Signal* const own = a.find(s.name);
      ASSERT_NE(own, nullptr) << s.name;
      EXPECT_EQ(own->layout, s.layout) << s.name;
    }
  }
}

TEST(PublicDatabases, AreReadAndHaveTheFingerprintsThatOurTestsExpect) {
  using namespace recordings;
  if (!is_here(kDatabases)) GTEST_SKIP() << how_to_get(kDatabases);
  for (const auto& path : public_files()) {
    expect_read(path);
    expect_read_leniently(path);
  }
  const auto folder = path_of(kDatabases);
  EXPECT_EQ(fingerprint(load(folder / "CAN1-INDY-V9.dbc")), kFingerprintOfV9);
  EXPECT_EQ(fingerprint(load(folder / "CAN1-INDY-V12.dbc")), kFingerprintOfV12);
  const Database fourteen = load(folder / "CAN1-INDY-V14.dbc");
  EXPECT_EQ(fingerprint(fourteen), kFingerprintOfV14);
  expect_equal(load(kOwnDbc), fourteen);
}

}  // namespace
}  // namespace pitwall::can
