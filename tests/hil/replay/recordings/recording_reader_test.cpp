// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/recording_reader.hpp"

#include <gtest/gtest.h>
#include <zstd.h>

#include "protocol/recording/lcm_log.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

std::string packed(const std::string& plain) {
  std::string out(ZSTD_compressBound(plain.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), plain.data(), plain.size(), 1));
  return out;
}

std::string lcm_log() {
  testing::ByteSink file;
  recording::LcmLogWriter writer{file.sink()};
  EXPECT_TRUE(writer.write(UtcTime{1'000}, "POSE", as_bytes("12345678")));
  return file.bytes;
}

TEST(RecordingReader, KnowsEveryFormatByItsContent) {
  NEEDS_ORACLES();
  const std::string gps = testing::novatel_position(2'297, 1'000);
  const std::string db3 = testing::bytes_of(testing::bag_db3("reader", 20));
  EXPECT_EQ(format_of(as_bytes(testing::black_box(2))), RecordingFormat::kMcap);
  EXPECT_EQ(format_of(as_bytes(db3)), RecordingFormat::kSqliteBag);
  EXPECT_EQ(format_of(as_bytes(lcm_log())), RecordingFormat::kLcm);
  EXPECT_EQ(format_of(as_bytes(gps)), RecordingFormat::kReceiver);
  EXPECT_EQ(format_of(as_bytes("(1.0) can0 123#00\n")), RecordingFormat::kNone);
  EXPECT_EQ(format_of({}), RecordingFormat::kNone);
  for (const std::string& file : {testing::black_box(2), db3, lcm_log(), gps}) {
    const auto plain = read_recording(file, "a");
    const auto from_packed = read_recording(packed(file), "a");
    ASSERT_TRUE(plain && from_packed);
    EXPECT_GT(plain->records.size(), 0U);
    EXPECT_EQ(testing::sorted_lines(*plain), testing::sorted_lines(*from_packed));
  }
}

TEST(RecordingReader, SaysWhatIsRead) {
  const auto text = read_recording(std::string{"(1.0) can0 123#00\n"}, "a.log");
  ASSERT_FALSE(text);
  EXPECT_EQ(to_string(text.error()),
            "a.log: error: is not a recording: expected MCAP, a bag of ROS 2 (.mcap, "
            ".db3), an event log of LCM, or the bytes of a NovAtel or VectorNav receiver");
  const std::string whole = packed(testing::black_box(2));
  const auto cut = read_recording(whole.substr(0, whole.size() / 2), "a.mcap.zstd");
  ASSERT_FALSE(cut);
  EXPECT_EQ(to_string(cut.error()), "a.mcap.zstd: error: cut Zstandard");
}

TEST(RecordingReader, EveryFormatHasAName) {
  EXPECT_EQ(to_string(RecordingFormat::kMcap), "MCAP");
  EXPECT_EQ(to_string(RecordingFormat::kNone), "no recording");
}

}  // namespace
}  // namespace pitwall::traffic
