// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/run_keys.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/session/keys.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

telemetry::KeyFile read(const std::string& path) {
  const auto text = transport::read_private_file(path);
  EXPECT_TRUE(text) << (text ? "" : to_string(text.error()));
  auto keys = telemetry::parse_key_file(text.value_or(""), path);
  EXPECT_TRUE(keys) << (keys ? "" : to_string(keys.error()));
  return *std::move(keys);
}

TEST(RunKeys, AreAPairThatFitsAndNewEachTime) {
  const auto folder = transport::TemporaryFolder::create("pitwall-keys-");
  const std::string keys = folder->path() + "/run/keys";
  telemetry::PublicKey before{};
  for (int run = 0; run < 2; ++run) {
    const auto made = make_run_keys(keys);
    ASSERT_TRUE(made) << to_string(made.error());
    const auto car = read(keys + "/car.keys"), base = read(keys + "/base.keys");
    EXPECT_EQ(car.role, telemetry::Role::kCar);
    EXPECT_EQ(base.role, telemetry::Role::kBase);
    EXPECT_EQ(car.peer, base.own.public_key);
    EXPECT_EQ(base.peer, car.own.public_key);
    EXPECT_NE(car.own.public_key, before);
    before = car.own.public_key;
  }
}

TEST(RunKeys, AFolderThatCannotBeMadeIsAProblemThatNamesIt) {
  const auto folder = transport::TemporaryFolder::create("pitwall-keys-");
  ASSERT_TRUE(transport::write_file(folder->path() + "/file", ""));
  const auto made = make_run_keys(folder->path() + "/file/keys");
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().place.find("/file/keys"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::bench
