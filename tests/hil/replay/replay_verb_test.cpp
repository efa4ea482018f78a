// What is refused before anything is sent; playing is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_verb.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/transport/file.hpp"

namespace pitwall::replay {
namespace {

class ReplayVerb : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(transport::write_file(good_, "(1.0) nosuchcan0 123#11\n"));
    ASSERT_TRUE(transport::write_file(
        bad_, "(1.0) nosuchcan0 123#11\n(1.1) nosuchcan0 123#1\n(1.2) nosuchcan0 123#11"));
  }
  std::string errors_of(const std::vector<std::string>& words) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(replay_verb(words), 2);
    return testing::internal::GetCapturedStderr();
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-verb-");
  std::string good_ = folder_.path() + "/good.log";
  std::string bad_ = folder_.path() + "/bad.log";
};

TEST_F(ReplayVerb, BadLinesAndACutTailAreToldBeforeAnythingIsSent) {
  const std::string said = errors_of({bad_});
  EXPECT_TRUE(said.starts_with(bad_ + ":2:23: warning: left out: ")) << said;
  EXPECT_NE(said.find(bad_ + ":3: warning: left out: "), std::string::npos) << said;
}

TEST_F(ReplayVerb, AFileThatIsNoLogIsNamedForWhatItLooksLike) {
  ASSERT_TRUE(transport::write_file(bad_, "MDF     4.10    "));
  const std::string said = errors_of({bad_});
  EXPECT_TRUE(said.starts_with(bad_ + ": error: looks like an ASAM MDF 4 recording")) << said;
  EXPECT_NE(said.find("candump"), std::string::npos) << said;
}

TEST_F(ReplayVerb, AMissingFileOrInterfaceIsNamed) {
  EXPECT_TRUE(errors_of({folder_.path() + "/none.log"}).starts_with(folder_.path()));
  EXPECT_TRUE(errors_of({good_}).starts_with("nosuchcan0: error: "));
}

TEST_F(ReplayVerb, WrongUsageIsNamed) {
  EXPECT_TRUE(errors_of({}).starts_with("replay: error: "));
  EXPECT_TRUE(errors_of({good_, "--speed", "fast"}).starts_with("fast: error: "));
  EXPECT_TRUE(errors_of({good_, "--speed", "0"}).starts_with("speed: error: "));
  EXPECT_TRUE(errors_of({good_, "--speed"}).starts_with("--speed: error: "));
  EXPECT_TRUE(errors_of({good_, "--loop", "0"}).starts_with("0: error: "));
  for (const char* late : {"never", "abort", "drop", "drop:", "drop:0", "drop:x", "catch-up:5"})
    EXPECT_TRUE(errors_of({good_, "--late", late}).starts_with(std::string(late) + ": error: "));
  EXPECT_TRUE(errors_of({good_, "--spin", "201"}).starts_with("201: error: "));
  EXPECT_TRUE(errors_of({good_, "--spin", "-1"}).starts_with("-1: error: "));
  EXPECT_TRUE(errors_of({good_, "--id", "20000000"}).starts_with("20000000: error: "));
  EXPECT_TRUE(errors_of({good_, "--id", "xyz"}).starts_with("xyz: error: "));
  EXPECT_TRUE(errors_of({good_, "--start", "-1"}).starts_with("-1: error: "));
  EXPECT_TRUE(errors_of({good_, "--skip", "nan"}).starts_with("nan: error: "));
  EXPECT_TRUE(errors_of({good_, "--map", "can0"}).starts_with("can0: error: "));
  EXPECT_TRUE(errors_of({good_, "--map", "can7=vcan0"}).starts_with("can7: error: "));
  EXPECT_TRUE(errors_of({good_, "--what", "1"}).starts_with("--what: error: "));
  EXPECT_TRUE(errors_of({good_, bad_}).starts_with(bad_ + ": error: "));
}

}  // namespace
}  // namespace pitwall::replay
