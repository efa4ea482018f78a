// pitwall-benchmarks: every benchmark with gates; `./pitwall bench NAME` runs it.
//   out    a table; with --json FILE the figures; exit code 0 held, 1 a gate missed, 2 wrong usage
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/control/bench_control.hpp"
#include "tests/benchmarks/control/bench_speed.hpp"
#include "tests/benchmarks/gateway/bench_gateway.hpp"
#include "tests/benchmarks/laps/bench_laps.hpp"
#include "tests/benchmarks/modules/bench_dbc.hpp"
#include "tests/benchmarks/modules/bench_ekf.hpp"
#include "tests/benchmarks/modules/bench_gnss.hpp"
#include "tests/benchmarks/modules/bench_plant.hpp"
#include "tests/benchmarks/perception/bench_camera.hpp"
#include "tests/benchmarks/perception/bench_perception.hpp"
#include "tests/benchmarks/protocol_comparison/bench_radio.hpp"
#include "tests/benchmarks/radio/radio_gates.hpp"
#include "tests/benchmarks/replay/bench_replay.hpp"
#include "tests/benchmarks/step/bench_step.hpp"
#include "tests/benchmarks/time_trial/bench_time_trial.hpp"
#include "tests/benchmarks/tracking/bench_tracking.hpp"

namespace pitwall::benchmarks {
namespace {

struct Benchmark {
  std::string_view name, help;
  int (*run)(std::span<const std::string> args);
};

constexpr std::array kBenchmarks{
    Benchmark{"camera", "the camera's detector on drawn images", bench_camera},
    Benchmark{"control", "control laws side by side, at held speeds on three ovals", bench_control},
    Benchmark{"dbc", "CAN databases: parse, decode, encode", bench_dbc},
    Benchmark{"ekf", "the filter of localization: its cost to the car", bench_ekf},
    Benchmark{"gateway", "27,000 frames/s of CAN, and every lost frame reported", bench_gateway},
    Benchmark{"gnss", "byte streams of the receivers", bench_gnss},
    Benchmark{"laps", "three ovals, nominal and perturbed", bench_laps},
    Benchmark{"lockstep", "closed loop in virtual time, against real time", bench_lockstep},
    Benchmark{"plant", "a step of the modelled car", bench_plant},
    Benchmark{"radio", "radio protocols side by side over one emulated link", bench_radio},
    Benchmark{"radio-gates", "the radio's gates at length, in virtual time", radio_gates},
    Benchmark{"replay", "replay of a CAN log beside canplayer and python-can", bench_replay},
    Benchmark{"speed", "longitudinal laws side by side, up and down the gears", bench_speed},
    Benchmark{"step", "one step of the car", bench_step},
    Benchmark{"time_trial", "laps of Las Vegas at the limit, 20 seeds", bench_time_trial},
    Benchmark{"perception", "LiDAR detectors on drawn scenes", bench_perception},
    Benchmark{"tracking", "trackers of other cars on the same detections", bench_tracking},
};

int usage(std::FILE* out, int code) {
  std::fprintf(out, "pitwall-benchmarks NAME [OPTION]...   (NAME --help for its options)\n\n");
  for (const Benchmark& one : kBenchmarks)
    std::fprintf(out, "  %-12s %s\n", one.name.data(), one.help.data());
  std::fprintf(out, "\nexit codes: 0 held, 1 a gate missed, 2 wrong usage or a failure\n");
  return code;
}

int run(std::span<const std::string> words) {
  if (words.empty()) return usage(stderr, kExitUnusable);
  if (words[0] == "--help" || words[0] == "help") return usage(stdout, kExitPass);
  for (const Benchmark& one : kBenchmarks)
    if (words[0] == one.name) return one.run(words.subspan(1));
  std::fprintf(stderr, "pitwall-benchmarks: error: unknown benchmark \"%s\"\n", words[0].c_str());
  return usage(stderr, kExitUnusable);
}

}  // namespace
}  // namespace pitwall::benchmarks

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  return pitwall::benchmarks::run(words);
}
