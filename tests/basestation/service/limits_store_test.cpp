// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/limits_store.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "protocol/transport/file.hpp"

namespace pitwall::service {
namespace {

constexpr std::string_view kBroken = "version: 1\nalarms:\n  - {alarm: wheel_slip, limit: far}\n";

class JudgementStoreTest : public ::testing::Test {
 protected:
  JudgementStoreTest() : folder_(*transport::TemporaryFolder::create("pitwall_judgement")) {}

  std::string path() const { return folder_.path() + "/wall.yaml"; }
  void write(std::string_view text) { ASSERT_TRUE(transport::write_file(path(), text)); }
  std::string text_of(const std::string& suffix = "") const {
    return transport::read_file(path() + suffix).value_or("no file");
  }
  // As the editor does it: everything as it is, one revision on.
  static Result<bool, Problem> save(LimitsStore& store, std::uint64_t revision) {
    const settings::Judgement& now = store.judgement();
    return store.save({.derive = now.derive,
                       .limits = now.limits,
                       .alarms = now.alarms,
                       .revision = revision,
                       .up_kbit_s = kUnset});
  }

  transport::TemporaryFolder folder_;
};

TEST_F(JudgementStoreTest, AFileThatIsNotThereIsMadeWithTheFirstChange) {
  LimitsStore store{path()};
  EXPECT_FALSE(store.unreadable());
  EXPECT_NE(store.remark().find("not there"), std::string::npos) << store.remark();
  EXPECT_EQ(text_of(), "no file");
  ASSERT_TRUE(save(store, 1));
  EXPECT_EQ(LimitsStore{path()}.judgement().revision, 1u);
  EXPECT_EQ(LimitsStore{path()}.remark(), "");
}

TEST_F(JudgementStoreTest, ABrokenFileIsNamedWithItsLineAndLeftAlone) {
  write(kBroken);
  const LimitsStore store{path()};
  ASSERT_TRUE(store.unreadable());
  EXPECT_TRUE(store.remark().starts_with("settings file unreadable: " + path() + ":3:"))
      << store.remark();
  EXPECT_TRUE(store.remark().ends_with("; built-in limits in force")) << store.remark();
  EXPECT_EQ(store.judgement().alarms.version(), alarms::AlarmSettings{}.version());
  EXPECT_EQ(store.judgement().revision, 0u);
  EXPECT_EQ(text_of(), kBroken);
}

TEST_F(JudgementStoreTest, AChangeKeepsTheBrokenFileBeside) {
  write(kBroken);
  LimitsStore store{path()};
  ASSERT_TRUE(save(store, 1));
  EXPECT_FALSE(store.unreadable());
  EXPECT_EQ(text_of(".broken"), kBroken);
  EXPECT_EQ(LimitsStore{path()}.judgement().revision, 1u);
  ASSERT_TRUE(save(store, 2));
  EXPECT_EQ(text_of(".broken.2"), "no file") << "only a broken file is kept";
}

TEST_F(JudgementStoreTest, NoFileThatWasKeptIsLost) {
  write("first");
  LimitsStore first{path()};
  ASSERT_TRUE(save(first, 1));
  write("second");
  LimitsStore second{path()};
  ASSERT_TRUE(save(second, 1));
  EXPECT_EQ(text_of(".broken"), "first");
  EXPECT_EQ(text_of(".broken.2"), "second");
}

TEST_F(JudgementStoreTest, WhatCannotBeKeptIsNotReplaced) {
  std::filesystem::create_directory(path());
  LimitsStore store{path()};
  ASSERT_TRUE(store.unreadable());
  const auto done = save(store, 1);
  ASSERT_FALSE(done);
  EXPECT_NE(to_string(done.error()).find("wall.yaml.broken"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_directory(path()));
  EXPECT_TRUE(store.unreadable());
}

}  // namespace
}  // namespace pitwall::service
