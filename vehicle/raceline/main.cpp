// pitwall-raceline: makes the bank of racelines of a track, offline, or checks one that there is.
// Wires files to the builder, the checks, the report and the picture.
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "protocol/transport/file.hpp"
#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/car_setup.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/raceline/apex_file.hpp"
#include "vehicle/raceline/bank_builder.hpp"
#include "vehicle/raceline/bank_file.hpp"
#include "vehicle/raceline/bank_picture.hpp"
#include "vehicle/raceline/bank_report.hpp"
#include "vehicle/raceline/line_check.hpp"
#include "vehicle/raceline/profile/lap_road.hpp"

namespace pitwall {
namespace {

constexpr int kExitDone = 0, kExitRefused = 2;

struct Arguments {
  std::string track_file, car_file, out_file, check_file, apex_file, picture_file, report_file,
      envelope_file;
  bool minimum_time = false;
  std::optional<double> tyre_c;  // of all tyres; warm where nothing is given
  std::optional<double> clearance_m;
};

int refuse(const Problem& problem) {
  std::fprintf(stderr, "pitwall-raceline: %s\n", to_string(problem).c_str());
  return kExitRefused;
}

void add_options(CLI::App& app, Arguments& args) {
  app.add_option("TRACK", args.track_file, "track file (vehicle/config/tracks/*.yaml)")->required();
  app.add_option("--car", args.car_file, "car file (vehicle/config/cars/*.yaml)")->required();
  auto* out = app.add_option("--out", args.out_file, "make the bank and write it here (.json)");
  auto* check = app.add_option("--check", args.check_file, "check this bank instead");
  check->excludes(out);
  app.add_option("--apexes", args.apex_file, "apexes chosen by a person (.yaml)")->excludes(check);
  app.add_option("--picture", args.picture_file, "write a picture here (.svg)");
  app.add_option("--report", args.report_file, "write the figures of the checks here (.json)");
  app.add_option("--envelope", args.envelope_file, "write the car's envelope here (.csv)");
  app.add_option("--tyre-c", args.tyre_c, "temperature of the tyres, C; warm if not given")
      ->check(CLI::Range(-50.0, 200.0));
  app.add_flag("--minimum-time", args.minimum_time, "find the line of minimum time, too")
      ->excludes(check);
  app.add_option("--clearance", args.clearance_m,
                 "beside the car to the sides of a lane, m; if not given, what the car file wants "
                 "to the walls")
      ->check(CLI::Range(0.0, 5.0))
      ->excludes(check);
}

double tyre_share(const pipeline::CarParams& car, std::optional<double> tyre_c) {
  return tyre_c ? world::share_at(car.planning.line.friction.tyres, *tyre_c) : 1.0;
}

Result<raceline::RacelineBank, Problem> make(const Arguments& args,
                                             const world::TrackDescription& description,
                                             const world::TrackMap& map,
                                             const pipeline::CarParams& car,
                                             const envelope::EnvelopeTable& table) {
  raceline::ChosenApexes chosen;
  if (!args.apex_file.empty()) {
    const auto text = transport::read_file(args.apex_file);
    if (!text) return Unexpected{text.error()};
    auto apexes = raceline::read_apexes(*text, args.apex_file, map);
    if (!apexes) return Unexpected{apexes.error()};
    chosen = *std::move(apexes);
  }
  raceline::BankParams params = parameters::bank_for(car);
  if (args.clearance_m) params.clearance_m = *args.clearance_m;
  if (args.minimum_time) params.fastest_for = &table;
  return raceline::build_bank(description, map, params, chosen);
}

Result<raceline::RacelineBank, Problem> load(const Arguments& args,
                                             const world::TrackDescription& description,
                                             const world::TrackMap& map,
                                             const raceline::CarLimits& limits) {
  const auto text = transport::read_file(args.check_file, raceline::kMaxBankBytes);
  if (!text) return Unexpected{text.error()};
  return raceline::read_bank(*text, args.check_file, description, map, limits);
}

std::optional<Problem> write(const std::string& path, const std::string& text) {
  if (path.empty()) return std::nullopt;
  const auto written = transport::write_file(path, text);
  if (!written) return written.error();
  std::printf("%s written\n", path.c_str());
  return std::nullopt;
}

int run(const Arguments& args) {
  const auto track_text = transport::read_file(args.track_file);
  if (!track_text) return refuse(track_text.error());
  const auto description = parameters::read_track(*track_text, args.track_file);
  if (!description) return refuse(description.error());
  const auto map = world::TrackMap::build(*description);
  if (!map) return refuse(map.error());
  const auto car = parameters::load_car(
      args.car_file, [](const std::string& path) { return transport::read_file(path); });
  if (!car) return refuse(car.error());
  const envelope::EnvelopeTable table{pipeline::envelope_of(car->params, *map, args.tyre_c)};
  const raceline::CarLimits limits = parameters::limits_of(car->params, table);
  auto bank = args.check_file.empty() ? make(args, *description, *map, car->params, table)
                                      : load(args, *description, *map, limits);
  if (!bank) return refuse(bank.error());
  if (args.check_file.empty()) bank->tyre_share = tyre_share(car->params, args.tyre_c);
  const raceline::Lanes lanes{*map};
  if (const auto problem = raceline::add_laps(*bank, lanes, table)) return refuse(*problem);
  std::vector<raceline::LineFigures> figures;
  for (const raceline::Raceline& line : bank->lines) {
    const auto checked = raceline::check_raceline(line, lanes, limits);
    if (!checked) return refuse(checked.error());
    figures.push_back(*checked);
  }
  std::printf("%s", raceline::report_text(*bank, figures).c_str());
  if (const auto problem = write(args.out_file, raceline::to_json(*bank))) return refuse(*problem);
  if (const auto problem = write(args.envelope_file, table.csv())) return refuse(*problem);
  if (const auto problem = write(args.picture_file, raceline::picture_of(*bank, *map)))
    return refuse(*problem);
  if (const auto problem = write(args.report_file, raceline::report_json(*bank, figures)))
    return refuse(*problem);
  return kExitDone;
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  CLI::App app{"pitwall-raceline: the bank of racelines of a track, made or checked offline"};
  pitwall::Arguments args;
  pitwall::add_options(app, args);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : pitwall::kExitRefused;
  }
  return pitwall::run(args);
}
