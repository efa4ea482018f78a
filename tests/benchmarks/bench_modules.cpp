// SPDX-License-Identifier: Apache-2.0
// How fast the small parts are: CAN decode (generated structs beside run-time plans), encode,
// telemetry, plant, frame length. Figures, no gates.
#include <benchmark/benchmark.h>

#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "hil/bus/frame_length.hpp"
#include "hil/plant/plant.hpp"
#include "protocol/can/av21.hpp"
#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/decode.hpp"
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
  for (auto _ : state) benchmark::DoNotOptimize(bus::frame_length(input[i++ % kFrames]));
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
