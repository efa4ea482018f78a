// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/run_keys.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "basestation/link/key_pair.hpp"

namespace pitwall::bench {
namespace {

telemetry::KeyFile read(const std::string& path, telemetry::Role role) {
  auto keys = link::read_keys(path, role);
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
    const auto car = read(keys + "/car.keys", telemetry::Role::kCar);
    const auto base = read(keys + "/base.keys", telemetry::Role::kBase);
    EXPECT_TRUE(car.bench && base.bench);
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

class KeysOfARun : public ::testing::Test {
 protected:
  KeysOfARun() {
    plan_.folder = folder_.path() + "/run";
    plan_.vehicle = {"vehicle"};
    plan_.base = {"base"};
    std::filesystem::create_directories(plan_.folder);
    EXPECT_TRUE(make_run_keys(given_));
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-keys-");
  const std::string given_ = folder_.path() + "/given";
  LivePlan plan_;
};

TEST_F(KeysOfARun, AreNewWhereNoneWereGiven) {
  const auto keys = keys_of_run(plan_, "");
  ASSERT_TRUE(keys) << to_string(keys.error());
  EXPECT_EQ(keys->folder, plan_.folder + "/keys");
  EXPECT_EQ(read(keys->folder + "/car.keys", telemetry::Role::kCar).peer,
            read(keys->folder + "/base.keys", telemetry::Role::kBase).own.public_key);
}

TEST_F(KeysOfARun, AreTakenWhereTheyLie) {
  const auto keys = keys_of_run(plan_, given_);
  ASSERT_TRUE(keys) << to_string(keys.error());
  EXPECT_EQ(keys->folder, given_);
  EXPECT_FALSE(keys->memory);
}

// As the host's files are in a guest.
TEST_F(KeysOfARun, OfAnotherUserAreCopiedIntoMemory) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may give a file away";
  constexpr uid_t kOther = 54'321;
  for (const std::string& path : {plan_.folder, given_, given_ + "/car.keys"})
    ASSERT_EQ(chown(path.c_str(), kOther, kOther), 0);
  std::string path;
  {
    const auto keys = keys_of_run(plan_, given_);
    ASSERT_TRUE(keys) << to_string(keys.error());
    path = keys->folder;
    EXPECT_NE(path, given_);
    EXPECT_EQ(transport::read_file(given_ + "/car.keys").value_or("1"),
              transport::read_private_file(path + "/car.keys").value_or("2"));
    EXPECT_EQ(read(path + "/base.keys", telemetry::Role::kBase).peer,
              read(path + "/car.keys", telemetry::Role::kCar).own.public_key);
    const auto fresh = keys_of_run(plan_, "");
    ASSERT_TRUE(fresh) << to_string(fresh.error());
    EXPECT_NE(read(fresh->folder + "/car.keys", telemetry::Role::kCar).peer,
              read(path + "/car.keys", telemetry::Role::kCar).peer);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  std::filesystem::remove(given_ + "/base.keys");
  const auto missing = keys_of_run(plan_, given_);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().place, given_ + "/base.keys");
  plan_.base.clear();
  EXPECT_TRUE(keys_of_run(plan_, given_)) << "only what its programs need";
}

}  // namespace
}  // namespace pitwall::bench
