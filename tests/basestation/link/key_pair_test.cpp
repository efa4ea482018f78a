// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/key_pair.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

#include "protocol/transport/file.hpp"

namespace pitwall::link {
namespace {

using telemetry::Role;

struct Folder {
  transport::TemporaryFolder temporary = *transport::TemporaryFolder::create("keys");
  std::string path = temporary.path() + "/new";
  telemetry::SeededRandomness randomness{1};
  KeyPair pair = make_key_pair(randomness);
  std::string car = path + "/car.keys", base = path + "/base.keys";
};

TEST(KeyPair, IsWrittenForItsOwnerOnlyAndReadsAsItWas) {
  Folder f;
  ASSERT_TRUE(write_key_pair(f.path, f.pair));
  for (const std::string& path : {f.car, f.base}) {
    struct stat status {};
    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
  }
  const auto car = read_keys(f.car, Role::kCar), base = read_keys(f.base, Role::kBase);
  ASSERT_TRUE(car && base);
  EXPECT_EQ(car->peer, base->own.public_key);
  EXPECT_EQ(base->peer, car->own.public_key);
  EXPECT_NE(car->own.secret_key.bytes, base->own.secret_key.bytes);
}

TEST(KeyPair, NothingIsReplaced) {
  for (const bool car_exists : {true, false}) {
    Folder f;
    ASSERT_TRUE(write_key_pair(f.path, f.pair));
    ASSERT_EQ(::unlink((car_exists ? f.base : f.car).c_str()), 0);
    const auto again = write_key_pair(f.path, f.pair);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().place, car_exists ? f.car : f.base);
    EXPECT_FALSE(transport::read_file(car_exists ? f.base : f.car)) << "and nothing is begun";
  }
}

TEST(KeyPair, EachEndTakesItsOwnFileOnly) {
  Folder f;
  ASSERT_TRUE(write_key_pair(f.path, f.pair));
  const auto swapped = read_keys(f.car, Role::kBase);
  ASSERT_FALSE(swapped);
  EXPECT_EQ(swapped.error().what, "these are the car's keys, expected the base's: give base.keys");
  EXPECT_FALSE(read_keys(f.base, Role::kCar));
  EXPECT_FALSE(read_keys(f.path + "/none", Role::kCar));
  ASSERT_EQ(::chmod(f.car.c_str(), 0644), 0);
  EXPECT_FALSE(read_keys(f.car, Role::kCar)) << "others can read it";
}

TEST(KeyPair, OfABenchSaysSoAtBothEnds) {
  Folder f;
  EXPECT_FALSE(f.pair.car.bench || f.pair.base.bench) << "only where it is asked for";
  ASSERT_TRUE(write_key_pair(f.path, make_key_pair(f.randomness, true)));
  const auto car = read_keys(f.car, Role::kCar), base = read_keys(f.base, Role::kBase);
  ASSERT_TRUE(car && base);
  EXPECT_TRUE(car->bench && base->bench);
}

TEST(KeyPair, LiesInAFolderThatNobodyElseMayWrite) {
  Folder f;
  const mode_t before = ::umask(0);
  EXPECT_TRUE(write_key_pair(f.path, f.pair));
  ::umask(before);
  EXPECT_TRUE(read_keys(f.car, Role::kCar)) << "whatever the umask was";
  Folder open;
  ASSERT_EQ(::mkdir(open.path.c_str(), 0700), 0);
  ASSERT_EQ(::chmod(open.path.c_str(), 0777), 0);
  const auto refused = write_key_pair(open.path, open.pair);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, open.path);
  EXPECT_FALSE(transport::read_file(open.car)) << "and nothing is begun";
}

}  // namespace
}  // namespace pitwall::link
