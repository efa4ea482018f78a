// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_codec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "protocol/gnss/novatel_stream.hpp"
#include "tests/protocol/gnss/random_messages.hpp"
#include "tests/protocol/gnss/recordings.hpp"

namespace pitwall::gnss {
namespace {

using Buffer = std::array<std::uint8_t, kMaxEncodedBytes>;

BestPos some_position() {
  BestPos m;
  m.solution_status = 0, m.position_type = 50;
  m.latitude_deg = 36.27, m.longitude_deg = -115.01, m.height_m = 594.25;
  m.undulation_m = -28.5F;
  m.latitude_sigma_m = 0.01F, m.longitude_sigma_m = 0.02F, m.height_sigma_m = 0.03F;
  m.station = {'L', '4', '0', 'X'};
  m.satellites_tracked = 21, m.satellites_used = 18, m.gps_glonass_mask = 0x33;
  return m;
}

TEST(NovatelCodec, WhatIsEncodedIsDecodedUnchanged) {
  std::mt19937_64 random{3};
  Buffer bytes{};
  for (int i = 0; i < 4'000; ++i) {
    const NovatelMessage message = random_message(static_cast<std::size_t>(i) % kLogs, random);
    const NovatelHeader header = random_header(random);
    const std::size_t n = encode(header, message, bytes);
    NovatelStream stream;
    int frames = 0;
    stream.feed(std::span{bytes}.first(n), [&](const NovatelFrame& frame) {
      ++frames;
      EXPECT_EQ(frame.header, as_sent(header, message));
      const auto decoded = decode(frame);
      ASSERT_TRUE(decoded.has_value()) << text(decoded.error());
      EXPECT_TRUE(*decoded == message);
    });
    ASSERT_EQ(frames, 1) << "message " << message.index();
    EXPECT_EQ(stream.counters().garbage_bytes, 0U);
  }
}

TEST(NovatelCodec, RefusesEveryTruncatedBodyAndTakesALongerOne) {
  std::mt19937_64 random{4};
  for (std::size_t i = 0; i < kLogs; ++i) {
    const NovatelMessage message = random_message(i, random);
    Buffer bytes{};
    const std::size_t n = encode({}, message, bytes);
    const std::size_t header = std::visit(
        [](const auto& m) { return m.kShort ? kShortHeaderBytes : kLongHeaderBytes; }, message);
    NovatelFrame frame;
    frame.header.id = std::visit([](const auto& m) { return m.kId; }, message);
    const auto body = std::span<const std::uint8_t>{bytes}.subspan(header, n - header);
    for (std::size_t keep = 0; keep < body.size() - kCrcBytes; ++keep) {
      frame.body = body.first(keep);
      const auto decoded = decode(frame);
      ASSERT_FALSE(decoded.has_value());
      EXPECT_EQ(decoded.error(), DecodeError::kTooShort);
    }
    frame.body = body;  // what newer firmware might append
    EXPECT_TRUE(decode(frame).has_value());
  }
}

TEST(NovatelCodec, RefusesNumbersThatAreNone) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    BestPos m = some_position();
    m.longitude_deg = bad;
    Buffer bytes{};
    const std::size_t n = encode({}, m, bytes);
    NovatelFrame frame{.header = {.id = BestPos::kId},
                       .body = std::span{bytes}.subspan(kLongHeaderBytes, n - kLongHeaderBytes)};
    const auto decoded = decode(frame);
    ASSERT_FALSE(decoded.has_value());
    EXPECT_EQ(decoded.error(), DecodeError::kNotFinite);
  }
}

TEST(NovatelCodec, RefusesResponsesOtherFormatsAndUnknownIds) {
  const std::array<std::uint8_t, BestPos::kBytes> zeros{};
  const auto verdict = [&](std::uint16_t id, std::uint8_t type) {
    return decode({.header = {.id = id, .message_type = type}, .body = zeros}).error();
  };
  EXPECT_EQ(verdict(BestPos::kId, 0x80), DecodeError::kResponse);
  EXPECT_EQ(verdict(BestPos::kId, 0x20), DecodeError::kNotBinary);
  EXPECT_EQ(verdict(1163, 0), DecodeError::kUnknownId);
}

// Oracle: what the vendor's own driver made of the same bytes.
TEST(NovatelCodec, ReadsHeadingsAsTheVendorsDriverDoes) {
  const auto bytes = recording("align.gps");
  if (!bytes) GTEST_SKIP() << "no recordings at " << recordings_folder();
  const auto lines = recorded_lines("align__novatel_oem7_heading2.jsonl");
  std::size_t i = 0;
  NovatelStream stream;
  stream.feed(*bytes, [&](const NovatelFrame& frame) {
    if (i == lines.size()) return;  // the recording is longer than what is decoded of it
    const std::string& line = lines[i++];
    const auto decoded = decode(frame);
    ASSERT_TRUE(decoded.has_value());
    const auto& m = std::get<Heading2>(*decoded);
    const std::pair<const char*, double> expected[] = {
        {"message_id", frame.header.id},
        {"time_status", frame.header.time_status},
        {"gps_week_number", frame.header.week},
        {"gps_week_milliseconds", frame.header.milliseconds},
        {"length", double{m.baseline_m}},
        {"heading", double{m.heading_deg}},
        {"pitch", double{m.pitch_deg}},
        {"heading_stdev", double{m.heading_sigma_deg}},
        {"pitch_stdev", double{m.pitch_sigma_deg}},
        {"num_sv_tracked", m.satellites_tracked},
        {"num_sv_in_sol", m.satellites_used},
        {"num_sv_obs", m.satellites_obs},
        {"num_sv_multi", m.satellites_multi},
        {"galileo_beidou_sig_mask", m.galileo_beidou_mask},
        {"gps_glonass_sig_mask", m.gps_glonass_mask}};
    for (const auto& [key, value] : expected) EXPECT_EQ(number_after(line, key), value) << key;
    EXPECT_NE(line.find("\"pos_type\": {\"type\": " + std::to_string(m.position_type)),
              std::string::npos);
    EXPECT_NE(line.find("\"sol_source\": {\"source\": " + std::to_string(m.solution_source)),
              std::string::npos);
    EXPECT_NE(line.find(std::string{m.rover_station.data(), 4}), std::string::npos);
  });
  EXPECT_EQ(i, lines.size());
  EXPECT_GE(i, 10U);
  EXPECT_EQ(stream.counters().garbage_bytes, 0U);
}

// What the receiver wrote and what we write of its values are the same bytes.
TEST(NovatelCodec, RecordedFramesSurviveDecodeAndEncodeToTheByte) {
  int compared = 0;
  for (const char* name : {"align.gps", "bestpos.gps"}) {
    const auto bytes = recording(name);
    if (!bytes) GTEST_SKIP() << "no recordings at " << recordings_folder();
    NovatelStream stream;
    stream.feed(*bytes, [&](const NovatelFrame& frame) {
      const auto decoded = decode(frame);
      if (!decoded) {
        EXPECT_EQ(decoded.error(), DecodeError::kUnknownId);
        return;
      }
      Buffer again{};
      const std::size_t n = encode(frame.header, *decoded, again);
      const std::size_t header = frame.header.short_form ? kShortHeaderBytes : kLongHeaderBytes;
      const std::size_t length = header + frame.body.size();
      const std::uint8_t* original = frame.body.data() - header;
      ASSERT_EQ(n, length + kCrcBytes);
      EXPECT_TRUE(
          std::equal(again.begin(), again.begin() + static_cast<std::ptrdiff_t>(n), original));
      ++compared;
    });
  }
  EXPECT_GE(compared, 30);
}

// Oracle: the driver's gps message takes its position from the BESTPOS or INSPVAS before it, its
// speed from the BESTVEL or INSPVAS.
TEST(NovatelCodec, ReadsPositionsAsTheVendorsDriverDoes) {
  const auto bytes = recording("bestpos.gps");
  if (!bytes) GTEST_SKIP() << "no recordings at " << recordings_folder();
  const auto fixes = recorded_lines("bestpos__gps_gps.jsonl");
  const auto is_said = [](const std::vector<std::string>& lines, const char* key, double value,
                          double tolerance = 0.0) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return std::fabs(number_after(line, key) - value) <= tolerance;
    });
  };
  std::map<std::uint16_t, int> ids;
  int places = 0, speeds = 0, climbs = 0;
  NovatelStream stream;
  stream.feed(*bytes, [&](const NovatelFrame& frame) {
    ++ids[frame.header.id];
    const auto decoded = decode(frame);
    if (!decoded) return;
    if (const auto* m = std::get_if<InsPvaS>(&*decoded)) {
      EXPECT_EQ(m->week, 2134U);
      if (is_said(fixes, "latitude", m->latitude_deg)) {
        ++places;
        EXPECT_TRUE(is_said(fixes, "longitude", m->longitude_deg));
        // The driver makes it a height above the sea as soon as it knows the undulation, -17 m.
        EXPECT_TRUE(is_said(fixes, "altitude", m->height_m) ||
                    is_said(fixes, "altitude", m->height_m + 17.0));
      }
      if (is_said(fixes, "climb", m->up_mps)) {
        ++climbs;  // then the speed is that of the same log
        EXPECT_TRUE(is_said(fixes, "speed", std::hypot(m->north_mps, m->east_mps), 1e-16));
      }
    }
    if (const auto* m = std::get_if<BestPos>(&*decoded)) {
      EXPECT_EQ(m->satellites_used, 16);
      EXPECT_EQ(m->undulation_m, -17.0F);
      if (is_said(fixes, "latitude", m->latitude_deg)) {
        ++places;
        EXPECT_TRUE(is_said(fixes, "longitude", m->longitude_deg));
        EXPECT_TRUE(is_said(fixes, "altitude", m->height_m));
      }
    }
    if (const auto* m = std::get_if<BestVel>(&*decoded)) {
      if (is_said(fixes, "speed", m->horizontal_mps)) ++speeds;
      EXPECT_LT(m->horizontal_mps, 0.1);
    }
  });
  EXPECT_EQ(stream.counters().garbage_bytes, 104U);  // it begins with answers to commands
  EXPECT_EQ(ids[1163], 2);                           // PSRDOP2, which the car does not need
  EXPECT_GE(places, 3);
  EXPECT_GE(speeds, 1);
  EXPECT_GE(climbs, 1);
}

// The same recording says INSPVAX, BESTPOS, BESTVEL and BESTUTM of one epoch: they agree.
TEST(NovatelCodec, TheLogsOfOneEpochAgree) {
  const auto bytes = recording("bestpos.gps");
  if (!bytes) GTEST_SKIP() << "no recordings at " << recordings_folder();
  const auto odometry = recorded_lines("bestpos__novatel_oem7_odom.jsonl");
  std::optional<InsPvaX> ins;
  std::optional<BestPos> position;
  int epochs = 0;
  NovatelStream stream;
  stream.feed(*bytes, [&](const NovatelFrame& frame) {
    const auto decoded = decode(frame);
    if (!decoded) return;
    if (const auto* m = std::get_if<InsPvaX>(&*decoded)) ins = *m;
    if (const auto* m = std::get_if<BestPos>(&*decoded)) position = *m;
    const auto* utm = std::get_if<BestUtm>(&*decoded);
    if (utm == nullptr) return;
    ++epochs;
    ASSERT_TRUE(ins && position);
    EXPECT_EQ(ins->ins_status, 7U);
    EXPECT_EQ(ins->undulation_m, position->undulation_m);
    EXPECT_EQ(ins->position_type, position->position_type);
    EXPECT_NEAR(ins->latitude_deg, position->latitude_deg, 1e-6);
    EXPECT_NEAR(ins->azimuth_deg, 90.0, 0.01);
    EXPECT_NEAR(ins->latitude_sigma_m, position->latitude_sigma_m, 1e-3);
    EXPECT_GT(ins->azimuth_sigma_deg, 7.9F);
    EXPECT_EQ(utm->height_m, position->height_m);
    EXPECT_EQ(utm->zone_number, 11U);
    EXPECT_EQ(utm->zone_letter, static_cast<std::uint32_t>('U'));
    EXPECT_EQ(utm->northing_sigma_m, position->latitude_sigma_m);
    // Everything that the driver places lies within 0.1 m of it.
    for (const std::string& line : odometry) {
      EXPECT_NEAR(number_after(line, "x"), utm->easting_m, 0.1);
      EXPECT_NEAR(number_after(line, "y"), utm->northing_m, 0.1);
    }
  });
  EXPECT_EQ(epochs, 2);
}

}  // namespace
}  // namespace pitwall::gnss
