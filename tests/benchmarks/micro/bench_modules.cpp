// SPDX-License-Identifier: Apache-2.0
// How fast the small parts are: CAN decode (generated structs beside run-time plans), encode, the
// judge of every frame, telemetry, plant, frame length. Figures, no gates.
#include <benchmark/benchmark.h>

#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "hil/can_bus/frame_length.hpp"
#include "hil/plant/plant.hpp"
#include "protocol/can/av21.hpp"
#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/can/message_monitor.hpp"
#include "protocol/telemetry/packet/group_codec.hpp"
#include "protocol/telemetry/packet/vehicle_state.hpp"
#include "protocol/telemetry/state_packet.hpp"

namespace pitwall {
namespace {

using can::av21::PtReport1;

constexpr std::size_t kFrames = 256;

// Frames with different bytes, so that nothing can be computed once and kept.
std::vector<can::Frame> frames() {
  std::vector<can::Frame> out(kFrames);
  std::uint64_t mix = 0x9E3779B97F4A7C15ULL;
  for (can::Frame& frame : out) {
    frame.id = PtReport1::kId;
    frame.length = PtReport1::kLength;
    mix = mix * 6364136223846793005ULL + 1442695040888963407ULL;
    std::memcpy(frame.data.data(), &mix, sizeof mix);
  }
  return out;
}

void decode_generated(benchmark::State& state) {
  const auto input = frames();
  PtReport1 report;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(can::av21::decode(input[i++ % kFrames], report));
    benchmark::DoNotOptimize(report);
  }
  state.SetItemsProcessed(
      state.iterations() *
      static_cast<std::int64_t>(std::tuple_size_v<decltype(PtReport1::kFields)>));
}
BENCHMARK(decode_generated);

void decode_by_plans(benchmark::State& state) {
  std::ifstream file(std::string(PITWALL_SOURCE_DIR) + "/protocol/can/dbc/av21.dbc");
  std::stringstream text;
  text << file.rdbuf();
  const auto database = can::parse_dbc(text.str(), "av21.dbc");
  if (!database) return state.SkipWithError("av21.dbc does not parse");
  const can::Message* message = database->find(PtReport1::kId);
  const auto input = frames();
  std::vector<double> values(message->signals.size());
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(can::decode(*message, input[i++ % kFrames], values));
    benchmark::DoNotOptimize(values.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(values.size()));
}
BENCHMARK(decode_by_plans);

void encode_generated(benchmark::State& state) {
  can::av21::SteeringCmd command;
  command.steering_motor_cmd_counter = 0.0;
  can::EncodeCounters counters;
  can::Frame frame;
  double angle_deg = -200.0;
  for (auto _ : state) {
    angle_deg = angle_deg > 200.0 ? -200.0 : angle_deg + 0.3;
    command.steering_motor_ang_cmd = angle_deg;
    benchmark::DoNotOptimize(can::av21::encode(command, frame, counters));
    benchmark::DoNotOptimize(frame);
  }
}
BENCHMARK(encode_generated);

// A counter of four bits in the low nibble of byte 1, or of byte 2 for profile 5.
can::MessageRow judged_row(can::Protection profile, std::uint8_t length, bool has_counter) {
  const bool is_wide = profile == can::Protection::kP05;
  can::MessageRow row{};
  row.length = length;
  row.period = milliseconds(10);
  row.timeout = milliseconds(50);
  row.has_counter = has_counter;
  row.counter_start = is_wide ? 16 : 8;
  row.counter_bits = is_wide ? 8 : 4;
  row.protection = {.profile = profile,
                    .length = length,
                    .counter_start = row.counter_start,
                    .counter_bits = row.counter_bits,
                    .data_id = 0x123};
  return row;
}

void judge_frames(benchmark::State& state, can::Protection profile, std::uint8_t length,
                  bool has_counter) {
  const can::MessageRow row = judged_row(profile, length, has_counter);
  std::vector<can::ReceivedFrame> input;
  can::ProtectState sender;
  for (can::Frame frame : frames()) {
    frame.length = length;
    can::ProtectionRule rule = row.protection;
    if (profile == can::Protection::kNone) {
      frame.data[1] = static_cast<std::uint8_t>(input.size() % 16);
    }
    can::protect(rule, sender, frame);
    input.push_back({frame, {}});
  }
  if (profile == can::Protection::kP01) input.resize(255);  // 15 does not divide 256
  can::MessageMonitor monitor;
  can::LossLog losses;
  Instant now{};
  std::size_t i = 0;
  for (auto _ : state) {
    can::ReceivedFrame& received = input[i];
    i = i + 1 == input.size() ? 0 : i + 1;
    received.at = now += row.period;
    benchmark::DoNotOptimize(can::judge(row, {}, monitor, received, losses));
  }
  if (monitor.bad + monitor.lost > 0) state.SkipWithError("the monitor found fault");
}
BENCHMARK_CAPTURE(judge_frames, plain, can::Protection::kNone, 8, false);
BENCHMARK_CAPTURE(judge_frames, counter, can::Protection::kNone, 8, true);
BENCHMARK_CAPTURE(judge_frames, sae_j1850, can::Protection::kJ1850, 8, true);
BENCHMARK_CAPTURE(judge_frames, e2e_p01, can::Protection::kP01, 8, true);
BENCHMARK_CAPTURE(judge_frames, e2e_p02, can::Protection::kP02, 8, true);
BENCHMARK_CAPTURE(judge_frames, e2e_p05, can::Protection::kP05, 8, true);
BENCHMARK_CAPTURE(judge_frames, e2e_p05_fd, can::Protection::kP05, 64, true);

void watch_270_messages(benchmark::State& state) {
  const std::vector<can::MessageRow> rows(270, judged_row(can::Protection::kNone, 8, true));
  std::vector<can::MessageMonitor> monitors(rows.size());
  can::LossLog losses;
  for (can::MessageMonitor& m : monitors) {
    static_cast<void>(can::judge(rows[0], {}, m, {}, losses));
  }
  for (auto _ : state) {
    can::watch(rows, monitors, Instant{} + milliseconds(12), losses);
    benchmark::DoNotOptimize(monitors.data());
  }
  if (losses.count > 0) state.SkipWithError("the monitor found fault");
}
BENCHMARK(watch_270_messages);

void telemetry_encode_and_parse(benchmark::State& state) {
  telemetry::StatePacket packet;
  for (double& value : packet.values.at) value = 1.0;
  telemetry::PacketBuffer buffer;
  telemetry::EncodeCounters counters;
  for (auto _ : state) {
    packet.sequence++;
    const auto bytes = telemetry::encode(packet, buffer, counters);
    benchmark::DoNotOptimize(telemetry::parse(bytes));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(buffer.size()));
}
BENCHMARK(telemetry_encode_and_parse);

// The hundred signals of the vehicle state; the design asks for 300 ns and 400 ns.
telemetry::Values moving_car() {
  telemetry::Values values;
  for (const telemetry::FieldIndex i : telemetry::kVehicleState) {
    const auto code = telemetry::kFields[i].quantized();
    values[i] = code.decode((i + 1) * 2'654'435'761U % code.count());
  }
  return values;
}

void vehicle_state_encode(benchmark::State& state) {
  const telemetry::Values values = moving_car();
  std::array<std::uint8_t, 128> buffer{};
  telemetry::CodecCounters counters;
  for (auto _ : state) {
    bits::BitWriter out{buffer};
    for (const telemetry::Group group : telemetry::kVehicleStateGroups)
      encode_group(group, values, out, counters);
    benchmark::DoNotOptimize(buffer.data());
  }
  if (counters.saturated > 0) state.SkipWithError("a value does not fit");
}
BENCHMARK(vehicle_state_encode);

void vehicle_state_decode(benchmark::State& state) {
  const telemetry::Values values = moving_car();
  std::array<std::uint8_t, 128> buffer{};
  telemetry::CodecCounters counters;
  bits::BitWriter out{buffer};
  for (const telemetry::Group group : telemetry::kVehicleStateGroups)
    encode_group(group, values, out, counters);
  telemetry::Values got;
  bool good = true;
  for (auto _ : state) {
    bits::BitReader in{buffer};
    for (const telemetry::Group group : telemetry::kVehicleStateGroups)
      good = decode_group(group, in, got) && good;
    benchmark::DoNotOptimize(got.at.data());
  }
  if (!good) state.SkipWithError("not what was written");
}
BENCHMARK(vehicle_state_decode);

void plant_millisecond(benchmark::State& state) {
  const plant::Params params;
  plant::State car = plant::rolling(params, plant::standing(params, 0.0, 0.0, 0.0), 60.0, 6);
  const plant::Actuation actuation{
      .steering_motor_rad = 0.5, .throttle_fraction = 0.5, .gear = 6, .ignition = true};
  for (auto _ : state) {
    car = plant::step(params, car, actuation, plant::Surface{.bank_rad = 0.3}, 0.001);
    benchmark::DoNotOptimize(car);
  }
}
BENCHMARK(plant_millisecond);

void frame_length_with_stuffing(benchmark::State& state) {
  const auto input = frames();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(can_bus::frame_length(input[i++ % kFrames]));
}
BENCHMARK(frame_length_with_stuffing);

}  // namespace
}  // namespace pitwall

// --json FILE is what ./pitwall bench passes; Google Benchmark calls it --benchmark_out.
int main(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  for (std::size_t i = 1; i + 1 < words.size(); ++i)
    if (words[i] == "--json") {
      words[i] = "--benchmark_out=" + words[i + 1];
      words[i + 1] = "--benchmark_out_format=json";
    }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
