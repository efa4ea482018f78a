// Public recordings of NovAtel OEM7 receivers, and what the vendor's own driver made of them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "tests/protocol/gnss/recordings.hpp"

namespace pitwall::gnss {
namespace {

// Oracle: what the vendor's own driver made of the same bytes.
void expect_headings_of_the_vendors_driver() {
  const auto bytes = recording("align.gps");
  ASSERT_TRUE(bytes);
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
void expect_frames_to_survive_to_the_byte() {
  int compared = 0;
  for (const char* name : {"align.gps", "bestpos.gps"}) {
    const auto bytes = recording(name);
    ASSERT_TRUE(bytes) << name;
    NovatelStream stream;
    stream.feed(*bytes, [&](const NovatelFrame& frame) {
      const auto decoded = decode(frame);
      if (!decoded) {
        EXPECT_EQ(decoded.error(), DecodeError::kUnknownId);
        return;
      }
      std::array<std::uint8_t, kMaxEncodedBytes> again{};
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
void expect_positions_of_the_vendors_driver() {
  const auto bytes = recording("bestpos.gps");
  ASSERT_TRUE(bytes);
  const auto fixes = recorded_lines("bestpos__gps_gps.jsonl");
  const auto is_stated = [](const std::vector<std::string>& lines, const char* key, double value,
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
      if (is_stated(fixes, "latitude", m->latitude_deg)) {
        ++places;
        EXPECT_TRUE(is_stated(fixes, "longitude", m->longitude_deg));
        // The driver makes it a height above the sea as soon as it knows the undulation, -17 m.
        EXPECT_TRUE(is_stated(fixes, "altitude", m->height_m) ||
                    is_stated(fixes, "altitude", m->height_m + 17.0));
      }
      if (is_stated(fixes, "climb", m->up_mps)) {
        ++climbs;  // then the speed is that of the same log
        EXPECT_TRUE(is_stated(fixes, "speed", std::hypot(m->north_mps, m->east_mps), 1e-16));
      }
    }
    if (const auto* m = std::get_if<BestPos>(&*decoded)) {
      EXPECT_EQ(m->satellites_used, 16);
      EXPECT_EQ(m->undulation_m, -17.0F);
      if (is_stated(fixes, "latitude", m->latitude_deg)) {
        ++places;
        EXPECT_TRUE(is_stated(fixes, "longitude", m->longitude_deg));
        EXPECT_TRUE(is_stated(fixes, "altitude", m->height_m));
      }
    }
    if (const auto* m = std::get_if<BestVel>(&*decoded)) {
      if (is_stated(fixes, "speed", m->horizontal_mps)) ++speeds;
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
void expect_the_logs_of_one_epoch_to_agree() {
  const auto bytes = recording("bestpos.gps");
  ASSERT_TRUE(bytes);
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

TEST(PublicNovatelLogs, AreReadAsTheVendorsDriverReadsThem) {
  using namespace recordings;
  if (!is_here(kNovatelLogs)) GTEST_SKIP() << how_to_get(kNovatelLogs);
  expect_headings_of_the_vendors_driver();
  expect_frames_to_survive_to_the_byte();
  expect_positions_of_the_vendors_driver();
  expect_the_logs_of_one_epoch_to_agree();
}

}  // namespace
}  // namespace pitwall::gnss
