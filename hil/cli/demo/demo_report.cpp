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
    base.silent_ms = map.number("silent_ms", 0.0, kAgeMax_ms);
    yaml::StrictMap age = map.map("age_ms");
    base.age_p50_ms = age.number("p50", 0.0, kAgeMax_ms);
    base.age_p99_ms = age.number("p99", 0.0, kAgeMax_ms);
    return base;  // its fields have more than this; that is the base station's own business
  } catch (const yaml::InputError& error) {
    return Unexpected{error.problem};
  }
}

Result<DemoReport, Problem> read_report(std::span<const DemoCar> cars) {
  const std::string& folder = cars.front().folder;
  auto run = transport::read_file(folder + "/run.json");
  if (!run) return Unexpected{run.error()};
  DemoReport report{
      .run_json = *std::move(run), .stations = {}, .dumped = lines_of(folder + "/candump.log")};
  for (const DemoCar& car : cars) {
    auto text = transport::read_file(car.folder + "/base.json");
    if (!text) return Unexpected{text.error()};
    const auto base = read_base(car.folder + "/base.json");
    if (!base) return Unexpected{base.error()};
    report.stations.push_back({car, *std::move(text), *base});
  }
  return report;
}

bool DemoReport::are_heard() const {
  return std::ranges::all_of(stations, [](const StationReport& station) {
    return station.base.packets > 0 && station.base.refused == 0;
  });
}

std::string to_text(const DemoReport& report) {
  std::string text;
  for (const StationReport& station : report.stations) {
    const BaseFigures& base = station.base;
    text += formatted(
        "base station, car %d %s: %lld packets, %.1f Hz, %lld lost, %lld refused; age of the "
        "newest value p50 %.1f ms, p99 %.1f ms; silent for the last %.1f s\n",
        station.car.number, station.car.name.c_str(), static_cast<long long>(base.packets),
        base.rate_hz, static_cast<long long>(base.lost), static_cast<long long>(base.refused),
        base.age_p50_ms, base.age_p99_ms, base.silent_ms / 1e3);
  }
  if (report.dumped > 0)
    text += "candump recorded " + std::to_string(report.dumped) +
            " frames: " + report.stations.front().car.folder + "/candump.log\n";
  return text;
}

std::string to_json(const DemoReport& report) {
  json::Array others;
  for (const StationReport& station : std::span{report.stations}.subspan(1))
    others.json(
        json::Object{}.text("name", station.car.name).json("base", station.base_json).str());
  return json::Object{}
      .json("run", report.run_json)
      .json("base", report.stations.front().base_json)
      .number("candump_frames", report.dumped)
      .json("others", others.str())
      .str();
}

std::string next_steps(const DemoReport& report, const std::string& scenario) {
  const DemoCar& own = report.stations.front().car;
  std::string text = "next:\n  the page of the run        " + own.folder +
                     "/report.html\n  the event log              " + own.folder +
                     "/events.mcap (Foxglove opens it)\n"
                     "  the console, once more     ./pitwall console --replay " +
                     own.base_recording() + " --web 8080\n";
  if (report.stations.size() == 1) text += "  a second full stack        ./pitwall demo --cars 2\n";
  return text + "  the same in virtual time   pitwall-hil run " + scenario + "\n";
}

}  // namespace pitwall::cli
