// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_report.hpp"

#include <algorithm>

#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::cli {
namespace {

constexpr std::int64_t kCountMax = 1'000'000'000;
constexpr double kRateMax_hz = 1e6, kAgeMax_ms = 1e9;

std::size_t lines_of(const std::string& path) {
  const auto text = transport::read_file(path);
  return text ? static_cast<std::size_t>(std::count(text->begin(), text->end(), '\n')) : 0;
}

}  // namespace

Result<BaseFigures, Problem> read_base(const std::string& path) {
  const auto document = yaml::load_file(path);
  if (!document) return Unexpected{document.error()};
  try {
    yaml::StrictMap map = document->root();
    BaseFigures base;
    base.packets = map.integer("packets", 0, kCountMax);
    base.lost = map.integer("lost", 0, kCountMax);
    base.refused = map.integer("refused", 0, kCountMax);
    base.rate_hz = map.number("rate_hz", 0.0, kRateMax_hz);
    if (base.packets == 0) return base;  // then no age is known
    yaml::StrictMap age = map.map("age_ms");
    base.age_p50_ms = age.number("p50", 0.0, kAgeMax_ms);
    base.age_p99_ms = age.number("p99", 0.0, kAgeMax_ms);
    return base;  // its fields have more than this; that is the base station's own business
  } catch (const yaml::InputError& error) {
    return Unexpected{error.problem};
  }
}

Result<CarReport, Problem> read_report(const DemoCar& car, int run_code) {
  auto run = transport::read_file(car.folder + "/run.json");
  if (!run) return Unexpected{run.error()};
  auto base_text = transport::read_file(car.folder + "/base.json");
  if (!base_text) return Unexpected{base_text.error()};
  const auto base = read_base(car.folder + "/base.json");
  if (!base) return Unexpected{base.error()};
  return CarReport{.car = car,
                   .run_code = run_code,
                   .run_json = *std::move(run),
                   .base_json = *std::move(base_text),
                   .base = *base,
                   .dumped = lines_of(car.folder + "/candump.log")};
}

std::string to_text(const CarReport& report) {
  const BaseFigures& base = report.base;
  std::string text = formatted(
      "base station: %lld packets, %.1f Hz, %lld lost, %lld refused; age of the newest value "
      "p50 %.1f ms, p99 %.1f ms\n",
      static_cast<long long>(base.packets), base.rate_hz, static_cast<long long>(base.lost),
      static_cast<long long>(base.refused), base.age_p50_ms, base.age_p99_ms);
  if (report.car.bus == DemoBus::kVcan) {
    text += "candump recorded " + std::to_string(report.dumped) + " frames: " + report.car.folder +
            "/candump.log\n";
  }
  return text + "event log: " + report.car.folder + "/events.mcap\n" +
         "the car's own recording: " + report.car.own_recording() + "\n";
}

std::string to_json(const CarReport& report) {
  return json::Object{}
      .json("run", report.run_json)
      .json("base", report.base_json)
      .number("candump_frames", report.dumped)
      .str();
}

bool are_apart(std::span<const CarReport> reports) {
  return std::ranges::all_of(reports, [](const CarReport& report) {
    return report.base.packets > 0 && report.base.refused == 0;
  });
}

std::string apart_text(std::span<const CarReport> reports) {
  std::string text = are_apart(reports) ? "apart:" : "NOT apart:";
  for (const CarReport& report : reports) {
    text += " car " + std::to_string(report.car.number) + " " +
            std::to_string(report.base.packets) + " packets under its own keys, " +
            std::to_string(report.base.refused) + " refused;";
  }
  text.back() = '\n';
  return text;
}

}  // namespace pitwall::cli
