// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/receiver_stream.hpp"

#include <gtest/gtest.h>

#include "hil/replay/recordings/recording_reader.hpp"
#include "protocol/gnss/novatel_ascii.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"
#include "tests/support/novatel_frames.hpp"

namespace pitwall::traffic {
namespace {

constexpr std::uint16_t kWeek = 2'297;
constexpr std::int64_t kGpsToUnix_s = 315'964'800 - 18;

UtcTime utc_of(std::int64_t week, std::int64_t milliseconds) {
  return {(week * 604'800 + kGpsToUnix_s) * kNanosecondsPerSecond +
          milliseconds * kNanosecondsPerMillisecond};
}

std::string joined(const Recording& recording) {
  std::string text;
  for (const Record& record : recording.records) {
    const Bytes bytes = record.bytes();
    text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return text;
}

std::string vectornav(std::uint64_t startup_ns, std::uint64_t gps_ns) {
  using namespace gnss::vectornav;
  gnss::VectorNavMessage message;
  message.output = gnss::VectorNavOutput{}.with(kTimeStartup).with(kTimeGps).with(kTimeStatus);
  message.time_startup_ns = startup_ns;
  message.time_gps_ns = gps_ns;
  message.time_status = gps_ns == 0 ? 0 : kTowValid | kDateValid | kUtcValid;
  std::array<std::uint8_t, gnss::kMaxVectorNavBytes> bytes{};
  const std::size_t n = gnss::encode(message, bytes);
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)};
}

TEST(ReceiverStream, EachMessageIsDueAtItsGpsTime) {
  std::string file;
  for (std::uint32_t i = 0; i < 50; ++i) file += testing::novatel_position(kWeek, 1'000 + 50 * i);
  const auto recording = read_receiver_stream(file, "a.gps");
  ASSERT_TRUE(recording);
  testing::expect_sound(*recording);
  ASSERT_EQ(recording->records.size(), 50U);
  for (std::uint32_t i = 0; i < 50; ++i)
    EXPECT_EQ(recording->records[i].at, utc_of(kWeek, 1'000 + 50 * i)) << i;
  EXPECT_EQ(joined(*recording), file);
  EXPECT_EQ(recording->sources[0].type, "novatel");
  EXPECT_EQ(testing::all_remarks(*recording), "");
}

// As its nanoseconds do not fit into 64 bits, week 20,000 would be any other time.
TEST(ReceiverStream, AWeekThatCannotBeIsNoTime) {
  const std::string file =
      testing::novatel_position(kWeek, 2'000) + testing::novatel_position(20'000, 2'010);
  const auto recording = read_receiver_stream(file, "a.gps");
  ASSERT_TRUE(recording);
  ASSERT_EQ(recording->records.size(), 2U);
  EXPECT_EQ(recording->records[1].at, utc_of(kWeek, 2'000));
  EXPECT_NE(testing::all_remarks(*recording).find("message without a time"), std::string::npos);
  EXPECT_FALSE(read_receiver_stream(testing::novatel_position(20'000, 1), "a.gps"));
}

TEST(ReceiverStream, ALateSolutionKeepsItsPlaceInTheStream) {
  const std::string file = testing::novatel_position(kWeek, 2'000) +
                           testing::novatel_position(kWeek, 1'980) +
                           testing::novatel_position(kWeek, 2'010);
  const auto recording = read_receiver_stream(file, "a.gps");
  ASSERT_TRUE(recording);
  EXPECT_EQ(joined(*recording), file);
  EXPECT_EQ(recording->records[1].at, utc_of(kWeek, 2'000));
  EXPECT_EQ(recording->records[2].at, utc_of(kWeek, 2'010));
  EXPECT_EQ(testing::all_remarks(*recording), "");
}

TEST(ReceiverStream, StepsBackAndMessagesWithoutATimeAreTold) {
  const std::string first = testing::novatel_position(0, 0);  // the receiver does not know yet
  const std::string file =
      first + testing::novatel_position(kWeek, 5'000) + testing::novatel_position(kWeek, 3'000);
  const auto recording = read_receiver_stream(file, "a.gps");
  ASSERT_TRUE(recording);
  for (const Record& record : recording->records) EXPECT_EQ(record.at, utc_of(kWeek, 5'000));
  EXPECT_EQ(testing::all_remarks(*recording),
            "a.gps: byte 0: message without a time: due with the one before\n"
            "a.gps: byte " +
                std::to_string(2 * first.size()) +
                ": time steps back by more than 1 s: due with the message before\n");
}

TEST(ReceiverStream, BytesOfNoMessageArePassedOnAndACutTailIsLeftOut) {
  const std::string a = testing::novatel_position(kWeek, 1'000);
  const std::string b = testing::novatel_position(kWeek, 1'050);
  for (std::size_t n = 0; n < b.size(); ++n) {
    const std::string file = a + "<OK\r\n" + b + b.substr(0, n);
    const auto recording = read_receiver_stream(file, "a.gps");
    ASSERT_TRUE(recording) << n;
    ASSERT_EQ(recording->records.size(), 2U) << n;
    EXPECT_EQ(joined(*recording), a + "<OK\r\n" + b) << n;
    EXPECT_EQ(recording->counters.lost_bytes, n);
    const std::string remarks = testing::all_remarks(*recording);
    EXPECT_NE(remarks.find("a.gps: byte " + std::to_string(a.size()) +
                           ": bytes of no message: passed on"),
              std::string::npos);
    EXPECT_EQ(remarks.find("cut message") != std::string::npos, n > 0) << n;
  }
}

// What the stream holds back at its end, because it might be the start of a long message, is
// decided.
TEST(ReceiverStream, BehindADamagedLengthTheLastMessagesAreFound) {
  std::string damaged = testing::novatel_position(kWeek, 1'050);
  damaged[9] = '\x07';  // it would be 1,800 bytes longer
  const std::string good = testing::novatel_position(kWeek, 1'000);
  const auto recording = read_receiver_stream(good + damaged + good + good, "a.gps");
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->records.size(), 3U);
}

TEST(ReceiverStream, AsciiAndBinaryAreMixed) {
  gnss::NovatelHeader header;
  header.week = kWeek;
  header.milliseconds = 1'020;
  std::array<std::uint8_t, gnss::kMaxAsciiBytes> bytes{};
  const std::size_t n = gnss::encode_ascii(header, gnss::BestVel{}, bytes);
  const std::string ascii{bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)};
  const std::string file =
      testing::novatel_position(kWeek, 1'000) + ascii + testing::novatel_position(kWeek, 1'050);
  const auto recording = read_receiver_stream(file, "a.gps");
  ASSERT_TRUE(recording);
  ASSERT_EQ(recording->records.size(), 3U);
  EXPECT_EQ(joined(*recording), file);
  EXPECT_EQ(recording->records[1].at, utc_of(kWeek, 1'020));
}

TEST(ReceiverStream, VectorNavSaysItsTimeToo) {
  std::string file;
  constexpr std::uint64_t kGps_ns = std::uint64_t{kWeek} * 604'800 * 1'000'000'000;
  for (std::uint64_t i = 0; i < 20; ++i)
    file += vectornav(5'000 + i, i < 2 ? 0 : kGps_ns + 1'000'000 * i);
  const auto recording = read_receiver_stream(file, "a.vn");
  ASSERT_TRUE(recording) << to_string(recording.error());
  EXPECT_EQ(recording->sources[0].type, "vectornav");
  ASSERT_EQ(recording->records.size(), 20U);
  EXPECT_EQ(recording->records[0].at, utc_of(kWeek, 2)) << "the first time that is known";
  EXPECT_EQ(recording->records[19].at, utc_of(kWeek, 19));
  EXPECT_EQ(joined(*recording), file);
}

TEST(ReceiverStream, WithoutGpsTimeItCountsFromTheReceiversStart) {
  const auto recording = read_receiver_stream(vectornav(5'000, 0) + vectornav(6'000, 0), "a.vn");
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->records[1].at, UtcTime{6'000});
  EXPECT_NE(testing::all_remarks(*recording).find("no message knows GPS time"), std::string::npos);
}

TEST(ReceiverStream, AnOldRecordingIsTold) {
  const auto recording = read_receiver_stream(testing::novatel_position(1'800, 0), "a.gps");
  ASSERT_TRUE(recording);
  EXPECT_NE(testing::all_remarks(*recording).find("before 2017"), std::string::npos);
}

TEST(ReceiverStream, RefusesWhatHasNoMessageOrNoTime) {
  const auto other = read_receiver_stream(std::string{"no receiver says this"}, "a");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().what, "holds no message of a NovAtel or VectorNav receiver");
  const auto timeless = read_receiver_stream(testing::novatel_position(0, 0), "a");
  ASSERT_FALSE(timeless);
  EXPECT_EQ(timeless.error().what,
            "holds no message with a time, so it is not known when to send them");
}

TEST(ReceiverStream, NoDamageIsSilent) {
  std::string file;
  for (std::uint32_t i = 0; i < 60; ++i) file += testing::novatel_position(kWeek, 1'000 + 50 * i);
  testing::Dice dice{11};
  for (int i = 0; i < 400; ++i) {
    const std::string bad = testing::damaged(file, dice);
    const auto recording = read_receiver_stream(bad, "a.gps");
    if (!recording) continue;
    testing::expect_sound(*recording);
    EXPECT_EQ(joined(*recording).size() + recording->counters.lost_bytes, bad.size());
    if (recording->records.size() != 60 && bad != file.substr(0, 104 * (bad.size() / 104))) {
      EXPECT_NE(testing::all_remarks(*recording), "") << i;
    }
  }
}

TEST(ReceiverStream, AMessageOfARealReceiverKeepsItsBytesAndItsTime) {
  const auto heading = recordings::bytes_of_hex(recordings::kHeading2);
  const std::string bytes{heading.begin(), heading.end()};
  const auto stream = read_receiver_stream(bytes, "align.gps");
  ASSERT_TRUE(stream) << to_string(stream.error());
  testing::expect_sound(*stream);
  EXPECT_EQ(stream->first(), utc_of(2'090, 408'227'000)) << "as the vendor's driver has it";
  EXPECT_EQ(joined(*stream), bytes);
}

TEST(ReceiverStream, EveryReceiverHasAName) {
  EXPECT_EQ(to_string(Receiver::kNovatel), "novatel");
  EXPECT_EQ(to_string(Receiver::kVectorNav), "vectornav");
  EXPECT_EQ(to_string(Receiver::kUnknown), "unknown receiver");
}

}  // namespace
}  // namespace pitwall::traffic
