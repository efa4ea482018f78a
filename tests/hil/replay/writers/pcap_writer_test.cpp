// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/pcap_writer.hpp"

#include <gtest/gtest.h>

#include "hil/replay/formats/pcap.hpp"
#include "hil/replay/formats/pcapng.hpp"
#include "tests/hil/replay/formats/made_log.hpp"
#include "tests/hil/replay/formats/tshark_oracle.hpp"

namespace pitwall::replay {
namespace {

TEST(PcapWriter, TsharkReadsTheSameFramesOfBothFormats) {
  const auto folder = transport::TemporaryFolder::create("pitwall-pcap-");
  ASSERT_TRUE(folder);
  for (const std::int64_t step_ns : {1'000, 1}) {
    const CanLog log = make_log({.frames = 500, .step_ns = step_ns});
    const std::string path = folder->path() + "/a.pcap";
    ASSERT_TRUE(transport::write_file(path, to_pcap(log)));
    oracle::expect_as_tshark(log, path, folder->path());
    ASSERT_TRUE(transport::write_file(path + "ng", to_pcapng(log)));
    oracle::expect_as_tshark(log, path + "ng", folder->path());
  }
}

TEST(PcapWriter, ALogWithoutFramesIsOneThatReads) {
  EXPECT_TRUE(read_pcap(to_pcap({}), "a").has_value());
  EXPECT_TRUE(read_pcapng(to_pcapng({}), "a").has_value());
}

}  // namespace
}  // namespace pitwall::replay
