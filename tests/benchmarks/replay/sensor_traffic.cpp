// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/sensor_traffic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "hil/sensors/receiver_bytes.hpp"
#include "protocol/recorder/can_record.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr Duration kStep = milliseconds(1);
constexpr Duration kImuPeriod = milliseconds(8);
constexpr Duration kFixPeriod = milliseconds(50);
constexpr std::array<Duration, kReceivers> kPhase{milliseconds(1), milliseconds(4)};
constexpr std::uint64_t kShortestLatency_us = 300;  // a message on a line of 1 Mbit/s, and a read
constexpr std::uint64_t kLatencyJitter_us = 500;
constexpr std::size_t kLargestRecord_bytes = std::size_t{1} << 18;

constexpr double kLatitude_deg = 36.27, kLongitude_deg = -115.01, kHeight_m = 594.0;
constexpr double kSpeed_mps = 60.0, kMetersPerDegree = 111'000.0;
constexpr double kGravity_mps2 = 9.81, kNoise = 0.05;

double noise(Random& random) { return kNoise * (random.uniform() - 0.5); }

world::GnssPosition position_at(Instant at, std::uint8_t unit, Random& random) {
  world::GnssPosition out;
  out.at = at;
  out.unit = unit;
  out.solution_status = world::kSolutionComputed;
  out.position_type = world::kPositionNarrowInt;
  out.latitude_deg = kLatitude_deg + at.seconds() * kSpeed_mps / kMetersPerDegree;
  out.longitude_deg = kLongitude_deg;
  out.height_m = kHeight_m + noise(random);
  out.latitude_sigma_m = out.longitude_sigma_m = out.height_sigma_m = kNoise;
  out.satellites = 20;
  return out;
}

world::GnssVelocity velocity_at(Instant at, std::uint8_t unit, Random& random) {
  world::GnssVelocity out;
  out.at = at;
  out.unit = unit;
  out.solution_status = world::kSolutionComputed;
  out.velocity_type = world::kPositionNarrowInt;
  out.horizontal_mps = kSpeed_mps + noise(random);
  out.track_over_ground_rad = 0.0;
  out.vertical_mps = noise(random);
  return out;
}

world::ImuSample motion_at(Instant at, std::uint8_t unit, Random& random) {
  world::ImuSample out;
  out.at = at;
  out.unit = unit;
  out.rate_rad_per_s = {noise(random), noise(random), noise(random)};
  out.specific_force_mps2 = {noise(random), noise(random), kGravity_mps2 + noise(random)};
  return out;
}

// One datagram after the other of one receiver, on a line of its own.
class ReceiverLine {
 public:
  ReceiverLine(std::vector<SensorDatagram>& to, UtcTime begin, std::size_t receiver)
      : to_(to), begin_(begin), receiver_(receiver), random_{.state = 21 + receiver} {}

  void step(Duration t) {
    const Duration since = t - kPhase[receiver_];
    if (since.ns < 0) return;
    const auto unit = static_cast<std::uint8_t>(receiver_);
    const Instant at = Instant{} + t;
    if (since.ns % kImuPeriod.ns == 0) send(t, sensors::to_novatel(motion_at(at, unit, random_)));
    if (since.ns % kFixPeriod.ns != 0) return;
    send(t, sensors::to_novatel(position_at(at, unit, random_)));
    send(t, sensors::to_novatel(velocity_at(at, unit, random_)));
  }

 private:
  void send(Duration t, const sensors::ReceiverBytes& message) {
    const std::uint64_t latency_us = kShortestLatency_us + random_.below(kLatencyJitter_us);
    const UtcTime stamp{begin_.ns + t.ns + microseconds(static_cast<std::int64_t>(latency_us)).ns};
    free_at_ = std::max(stamp, free_at_);
    const auto bytes = message.span();
    to_.push_back({.at = free_at_, .receiver = receiver_, .bytes = {bytes.begin(), bytes.end()}});
  }

  std::vector<SensorDatagram>& to_;
  UtcTime begin_, free_at_{};
  std::size_t receiver_;
  Random random_;
};

struct Entry {
  UtcTime at;
  std::size_t frame = 0, datagram = 0;  // of which the other one is the count of its list
};

std::vector<Entry> in_order(const replay::CanLog& log,
                            const std::vector<SensorDatagram>& datagrams) {
  std::vector<Entry> out;
  UtcTime latest{};
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    latest = std::max(latest, log.frames[i].at);
    out.push_back({.at = latest, .frame = i, .datagram = datagrams.size()});
  }
  for (std::size_t i = 0; i < datagrams.size(); ++i)
    out.push_back({.at = datagrams[i].at, .frame = log.frames.size(), .datagram = i});
  std::ranges::stable_sort(out, {}, &Entry::at);
  return out;
}

}  // namespace

std::vector<SensorDatagram> sensor_traffic(UtcTime begin, Duration length) {
  std::vector<SensorDatagram> out;
  for (std::size_t receiver = 0; receiver < kReceivers; ++receiver) {
    ReceiverLine line{out, begin, receiver};
    for (Duration t{}; t < length - kStep; t = t + kStep) line.step(t);
  }
  std::ranges::stable_sort(out, {}, &SensorDatagram::at);
  return out;
}

Result<std::string, Problem> to_recording(const replay::CanLog& log,
                                          const std::vector<SensorDatagram>& datagrams) {
  std::string out;
  const auto sink = [&out](std::span<const std::uint8_t> bytes) {
    out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return true;
  };
  recording::McapWriter writer{
      recorder::channels(), {}, sink, {.chunk_bytes = kLargestRecord_bytes}};
  recorder::CanBytes buffer;
  for (const Entry& entry : in_order(log, datagrams)) {
    const Instant at{entry.at.ns};
    if (entry.frame < log.frames.size()) {
      writer.write({recorder::kCanInChannel}, at,
                   recorder::encode(log.frames[entry.frame].frame, buffer));
    } else {
      const SensorDatagram& datagram = datagrams[entry.datagram];
      writer.write({static_cast<std::uint16_t>(recorder::kReceiverChannel + datagram.receiver)}, at,
                   datagram.bytes);
    }
  }
  writer.close();
  if (const std::uint64_t refused = writer.counters().refused(); refused > 0)
    return Unexpected{
        Problem{"recording", "does not take " + std::to_string(refused) + " records"}};
  return out;
}

}  // namespace pitwall::benchmarks
