// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/bench_gnss.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "protocol/gnss/novatel_ascii.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "protocol/gnss/vectornav_stream.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "vehicle/receivers/receiver.hpp"
#include "vehicle/receivers/vectornav_outputs.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr double kShareLimit = 0.02;  // of one core
constexpr int kMinute_ms = 60'000, kReceivers = 2, kRuns = 9;
constexpr double kMinute_s = 1e-3 * kMinute_ms;
constexpr int kTick_ms = 10;  // of the car
constexpr int kDelay_ms = 2;  // of every log
constexpr std::uint16_t kWeek = 2209;
constexpr std::size_t kPortPiece = 64;  // what a serial port hands out at a time
// Milliseconds between two of a kind.
constexpr int kImuEvery_ms = 8, kInsEvery_ms = 20, kFixEvery_ms = 50, kHeadingEvery_ms = 1'000;

// One minute of one receiver.
struct Recording {
  std::vector<std::uint8_t> bytes;
  std::vector<std::size_t> ends;  // of what is said in each millisecond
  std::size_t logs = 0;

  void add(std::span<const std::uint8_t> log) {
    bytes.insert(bytes.end(), log.begin(), log.end());
    ++logs;
  }
  void end_millisecond() { ends.push_back(bytes.size()); }
};

// A lap's worth of change, so that no two logs are the same.
double swing(int ms, double size) { return size * std::sin(1e-3 * ms); }

gnss::BestPos position_at(int ms) {
  gnss::BestPos m{.solution_status = 0, .position_type = 50};
  m.latitude_deg = 36.27 + swing(ms, 0.003), m.longitude_deg = -115.01 + swing(ms, 0.004);
  m.height_m = 594.0 + swing(ms, 5.0), m.undulation_m = -28.5F;
  m.latitude_sigma_m = m.longitude_sigma_m = 0.0112F, m.height_sigma_m = 0.0231F;
  m.station = {'L', '4', '0', 'X'}, m.differential_age_s = 1.0F;
  m.satellites_tracked = 21, m.satellites_used = 18;
  return m;
}

gnss::BestVel velocity_at(int ms) {
  gnss::BestVel m{.solution_status = 0, .velocity_type = 8};
  m.horizontal_mps = 68.0 + swing(ms, 2.0), m.vertical_mps = swing(ms, 0.5);
  m.track_over_ground_deg = 180.0 + swing(ms, 179.0);
  return m;
}

gnss::Heading2 heading_at(int ms) {
  gnss::Heading2 m{.solution_status = 0, .position_type = 50, .baseline_m = 1.933F};
  m.heading_deg = static_cast<float>(180.0 + swing(ms, 179.0));
  m.heading_sigma_deg = m.pitch_sigma_deg = 0.083F;
  m.rover_station = m.master_station = {'L', '4', '0', 'X'};
  return m;
}

gnss::InsPvaX ins_at(int ms) {
  gnss::InsPvaX m{.ins_status = 3, .position_type = 56};
  m.latitude_deg = 36.27 + swing(ms, 0.003), m.longitude_deg = -115.01 + swing(ms, 0.004);
  m.height_m = 594.0 + swing(ms, 5.0), m.undulation_m = -28.5F;
  m.north_mps = swing(ms, 68.0), m.east_mps = swing(ms + 1'571, 68.0), m.up_mps = swing(ms, 0.5);
  m.roll_deg = -20.0 + swing(ms, 1.0), m.pitch_deg = swing(ms, 1.0);
  m.azimuth_deg = 180.0 + swing(ms, 179.0);
  m.latitude_sigma_m = m.longitude_sigma_m = m.height_sigma_m = 0.0121F;
  m.north_sigma_mps = m.east_sigma_mps = m.up_sigma_mps = 0.0211F;
  m.roll_sigma_deg = m.pitch_sigma_deg = m.azimuth_sigma_deg = 0.0312F;
  return m;
}

gnss::RawImuSx imu_at(int ms) {
  gnss::RawImuSx m{.week = kWeek, .seconds = 1e-3 * ms, .imu_status = 0xEA59FE00};
  const auto counts = [ms](double size) { return static_cast<std::int32_t>(swing(ms, size)); };
  m.z_accel = 329'308'016 + counts(1e6), m.minus_y_accel = counts(3e6), m.x_accel = counts(5e6);
  m.z_gyro = counts(2e5), m.minus_y_gyro = counts(4e5), m.x_gyro = counts(1e6);
  return m;
}

Recording novatel_minute(bool ascii) {
  Recording r;
  std::array<std::uint8_t, gnss::kMaxAsciiBytes> log{};
  for (int ms = 0; ms < kMinute_ms; ++ms) {
    gnss::NovatelHeader header;
    header.week = kWeek, header.milliseconds = static_cast<std::uint32_t>(ms);
    const auto say = [&](const gnss::NovatelMessage& message) {
      const std::size_t n =
          ascii ? gnss::encode_ascii(header, message, log) : gnss::encode(header, message, log);
      r.add(std::span{log}.first(n));
    };
    if (ms % kImuEvery_ms == 0) say(imu_at(ms));
    if (ms % kInsEvery_ms == 0) say(ins_at(ms));
    if (ms % kFixEvery_ms == 0) say(position_at(ms)), say(velocity_at(ms));
    if (ms % kHeadingEvery_ms == 0) say(heading_at(ms));
    r.end_millisecond();
  }
  return r;
}

gnss::VectorNavMessage vectornav_at(int ms) {
  const auto swung = [ms](double size) { return static_cast<float>(swing(ms, size)); };
  gnss::VectorNavMessage m;
  m.time_gps_ns = (kWeek * std::uint64_t{gnss::kWeek_ms} + static_cast<unsigned>(ms)) * 1'000'000;
  m.accel_mps2 = {swung(10.0), swung(20.0), -9.8F};
  m.rate_rad_per_s = {swung(0.1), swung(0.1), swung(0.4)};
  m.yaw_pitch_roll_deg = {swung(179.0), swung(1.0), 20.0F + swung(1.0)};
  m.yaw_pitch_roll_u_deg = {0.1F, 0.05F, 0.05F};
  m.ins_status = gnss::vectornav::kInsTracking | gnss::vectornav::kInsGnssFix;
  m.latitude_deg = 36.27 + swing(ms, 0.003), m.longitude_deg = -115.01 + swing(ms, 0.004);
  m.altitude_m = 566.0 + swing(ms, 5.0);
  m.ned_mps = {swung(68.0), swung(40.0), swung(0.5)};
  m.position_u_m = 0.02F, m.velocity_u_mps = 0.03F;
  gnss::VectorNavSolution& fix = m.gnss[0];
  fix.tow_ns = static_cast<std::uint64_t>(ms) * 1'000'000, fix.week = kWeek;
  fix.satellites = 18, fix.fix = gnss::vectornav::kRtkFixed;
  fix.latitude_deg = m.latitude_deg, fix.longitude_deg = m.longitude_deg;
  fix.altitude_m = m.altitude_m;
  fix.ned_mps = m.ned_mps, fix.position_u_m = {0.01F, 0.01F, 0.02F}, fix.velocity_u_mps = 0.03F;
  return m;
}

Recording vectornav_minute() {
  Recording r;
  constexpr auto& outputs = receivers::kVectorNavOutputs;
  constexpr std::array kEvery_ms{kImuEvery_ms, kFixEvery_ms, kInsEvery_ms};  // in their order
  std::array<std::uint8_t, gnss::kMaxVectorNavBytes> log{};
  for (int ms = 0; ms < kMinute_ms; ++ms) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      if (ms % kEvery_ms[i] != 0) continue;
      gnss::VectorNavMessage message = vectornav_at(ms);
      message.output = outputs[i];
      r.add(std::span{log}.first(gnss::encode(message, log)));
    }
    r.end_millisecond();
  }
  return r;
}

// The minute in the pieces in which ports deliver it; listen(piece, millisecond).
template <class Listen>
void replay(const Recording& r, Listen listen) {
  std::size_t at = 0;
  for (int ms = 0; ms < kMinute_ms; ++ms) {
    for (const std::size_t end = r.ends[static_cast<std::size_t>(ms)]; at < end;) {
      const std::size_t n = std::min(kPortPiece, end - at);
      listen(std::span{r.bytes}.subspan(at, n), ms);
      at += n;
    }
  }
}

// Found, checked and decoded by both; how many logs.
template <class Stream>
std::size_t decode_all(const Recording& r, std::vector<Stream> streams) {
  std::size_t decoded = 0;
  replay(r, [&](std::span<const std::uint8_t> piece, int) {
    for (Stream& stream : streams) {
      stream.feed(piece, [&](const auto& frame) { decoded += gnss::decode(frame) ? 1U : 0U; });
    }
  });
  return decoded;
}

// The whole way to what the car thinks in, a new list each tick; how many IMU samples.
std::size_t hear_all(const Recording& r, world::ReceiverKind kind) {
  std::vector<receivers::Receiver> both;
  for (std::uint8_t unit = 0; unit < kReceivers; ++unit) {
    both.emplace_back(unit, world::ReceiverParams{.kind = kind});
  }
  world::SensorInput input;
  std::size_t samples = 0;
  int tick = 0;
  replay(r, [&](std::span<const std::uint8_t> piece, int ms) {
    if (ms / kTick_ms != tick) {
      tick = ms / kTick_ms;
      samples += input.imu.size();
      input = {};
    }
    const Instant arrival{(ms + kDelay_ms) * std::int64_t{1'000'000}};
    for (receivers::Receiver& receiver : both) receiver.feed(piece, arrival, input);
  });
  return samples + input.imu.size();
}

struct Share {
  double median = 0.0, least = 0.0;  // of a core
};

template <class Work>
Share timed(Work work) {
  std::array<double, kRuns> shares{};
  for (double& share : shares) {
    const Instant begun = transport::monotonic_now();
    work();
    share = (transport::monotonic_now() - begun).seconds() / kMinute_s;
  }
  std::sort(shares.begin(), shares.end());
  return {shares[kRuns / 2], shares.front()};
}

struct Row {
  const char* name = "";
  const char* key = "";
  double bytes_per_s = 0.0, logs_per_s = 0.0;
  Share decoded = {}, whole_way = {};
  bool complete = true;  // every log was decoded, every IMU sample came out

  bool held() const { return whole_way.median <= kShareLimit && complete; }
};

template <class Stream>
Row measure(Row row, const Recording& r, const Stream& stream, world::ReceiverKind kind) {
  row.bytes_per_s = kReceivers * static_cast<double>(r.bytes.size()) / kMinute_s;
  row.logs_per_s = kReceivers * static_cast<double>(r.logs) / kMinute_s;
  const std::vector<Stream> streams(kReceivers, stream);
  constexpr std::size_t kSamples = kReceivers * kMinute_ms / kImuEvery_ms;
  row.decoded =
      timed([&] { row.complete = decode_all(r, streams) == kReceivers * r.logs && row.complete; });
  row.whole_way = timed([&] { row.complete = hear_all(r, kind) == kSamples && row.complete; });
  return row;
}

std::vector<Row> measure_all() {
  using world::ReceiverKind;
  return {measure({.name = "two NovAtel, binary", .key = "novatel_binary"}, novatel_minute(false),
                  gnss::NovatelStream{}, ReceiverKind::kNovatelOem7),
          measure({.name = "two NovAtel, ASCII", .key = "novatel_ascii"}, novatel_minute(true),
                  gnss::NovatelStream{}, ReceiverKind::kNovatelOem7),
          measure({.name = "two VN-310", .key = "vectornav"}, vectornav_minute(),
                  gnss::VectorNavStream{receivers::kVectorNavOutputs}, ReceiverKind::kVectorNav)};
}

std::string json_of(const std::vector<Row>& rows, bool held) {
  json::Object json;
  json.text("bench", "gnss").number("gate_share", kShareLimit);
  for (const Row& row : rows) {
    const std::string key = row.key;
    json.number(key + "_share", row.whole_way.median)
        .number(key + "_least_share", row.whole_way.least)
        .number(key + "_decode_share", row.decoded.median)
        .number(key + "_bytes_per_s", row.bytes_per_s)
        .number(key + "_logs_per_s", row.logs_per_s);
  }
  return json.flag("held", held).str() + "\n";
}

}  // namespace

int bench_gnss(std::span<const std::string> args) {
  std::string json_file;
  CommandLine app{"pitwall-benchmarks gnss: what two satellite receivers cost the car"};
  app.option("--json", json_file, "write the figures here");
  if (const auto code = app.ended_by(args)) return *code;
  const std::vector<Row> rows = measure_all();
  const bool held = std::all_of(rows.begin(), rows.end(), [](const Row& r) { return r.held(); });
  std::printf(
      "two receivers at full rate for a minute, %d runs; %% of a core, median\n"
      "%-22s %9s %9s %9s %10s %9s\n",
      kRuns, "", "bytes/s", "logs/s", "decoded", "as samples", "least");
  for (const Row& row : rows) {
    std::printf("%-22s %9.0f %9.0f %9.3f %10.3f %9.3f%s\n", row.name, row.bytes_per_s,
                row.logs_per_s, 100.0 * row.decoded.median, 100.0 * row.whole_way.median,
                100.0 * row.whole_way.least, row.complete ? "" : "  not every log came out");
  }
  std::printf("gate: as samples at most %.0f %% of a core, every log came out: %s\n",
              100.0 * kShareLimit, held ? "held" : "MISSED");
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, json_of(rows, held));
    if (!written) return refuse(written.error());
  }
  return held ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
