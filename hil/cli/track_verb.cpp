// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/track_verb.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/report/text.hpp"
#include "hil/track_file/track_check.hpp"
#include "hil/track_file/track_fit.hpp"
#include "hil/track_file/track_picture.hpp"
#include "hil/track_file/track_yaml.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"
#include "vehicle/parameters/track_file.hpp"

namespace pitwall::cli {
namespace {

constexpr std::size_t kMaxTrackBytes = std::size_t{16} << 20U;

struct TrackOptions {
  std::string file, out, json_file;
  track_file::FitOptions fit;
  std::vector<double> datum;
};

struct Track {
  world::TrackDescription description;
  world::TrackMap map;
  std::optional<track_file::Fit> fit;  // of a CSV
};

std::string name_of(const TrackOptions& options) {
  return options.fit.name.empty() ? std::filesystem::path(options.file).stem().string()
                                  : options.fit.name;
}

Result<track_file::Fit, Problem> import(const TrackOptions& options) {
  const auto text = transport::read_file(options.file, track_file::kMaxCsvBytes);
  if (!text) return Unexpected{text.error()};
  const auto csv = track_file::read_track_csv(*text, options.file);
  if (!csv) return Unexpected{csv.error()};
  track_file::FitOptions fit = options.fit;
  fit.name = name_of(options);
  if (!options.datum.empty()) {
    fit.latitude_deg = options.datum[0], fit.longitude_deg = options.datum[1];
    fit.height_m = options.datum[2];
  }
  return track_file::fit_track(*csv, fit);
}

Result<Track, Problem> load(const TrackOptions& options) {
  std::optional<track_file::Fit> fit;
  Result<world::TrackDescription, Problem> description = world::TrackDescription{};
  if (std::filesystem::path(options.file).extension() == ".yaml") {
    const auto text = transport::read_file(options.file, kMaxTrackBytes);
    if (!text) return Unexpected{text.error()};
    description = parameters::read_track(*text, options.file);
  } else {
    auto imported = import(options);
    if (!imported) return Unexpected{imported.error()};
    description = imported->track;
    fit = *std::move(imported);
  }
  if (!description) return Unexpected{description.error()};
  auto map = world::TrackMap::build(*description);
  if (!map) return Unexpected{map.error()};
  return Track{*std::move(description), *std::move(map), std::move(fit)};
}

std::string import_text(const track_file::Fit& fit) {
  std::string out = formatted(
      "import     %zu points left out (at the place of another, or the first again); the smoothed "
      "line lies within %.2f m of every other\n",
      fit.removed, fit.moved_m);
  if (std::isfinite(fit.height_range_m))
    out += formatted(
        "height     %.1f m between lowest and highest, steepest %.1f %%: not kept, a track file is "
        "flat\n",
        fit.height_range_m, 100.0 * fit.gradient_max);
  return out;
}

int check(const TrackOptions& options) {
  const auto track = load(options);
  if (!track) return refuse(track.error());
  const track_file::TrackReport report = track_file::check_track(track->description, track->map);
  std::printf("%s", track_file::to_text(report).c_str());
  if (track->fit) std::printf("%s", import_text(*track->fit).c_str());
  if (options.json_file.empty()) return kExitPass;
  const auto written = transport::write_file(options.json_file, track_file::to_json(report));
  return written ? kExitPass : refuse(written.error());
}

int import_to(const TrackOptions& options) {
  const auto track = load(options);
  if (!track) return refuse(track.error());
  if (!track->fit)
    return refuse({options.file, "is a track file already; expected a CSV file to import"});
  std::vector<std::string> remarks{"Imported from " + options.file + ".",
                                   formatted("Line smoothed below %.0f m, knots every %.1f m.",
                                             options.fit.smoothing_m, options.fit.knot_spacing_m)};
  if (options.datum.empty()) {
    remarks.emplace_back("The datum was not given: 0 N, 0 E is no place for this track.");
    std::printf("note: no --datum: the file says 0 N, 0 E, which will do in the bench alone\n");
  }
  const auto written =
      transport::write_file(options.out, track_file::to_yaml(track->description, remarks));
  if (!written) return refuse(written.error());
  std::printf("%s%s%s written\n",
              track_file::to_text(track_file::check_track(track->description, track->map)).c_str(),
              import_text(*track->fit).c_str(), options.out.c_str());
  return kExitPass;
}

int picture(const TrackOptions& options) {
  const auto track = load(options);
  if (!track) return refuse(track.error());
  const auto written = transport::write_file(options.out, track_file::picture_of(track->map));
  if (!written) return refuse(written.error());
  std::printf("%s written\n", options.out.c_str());
  return kExitPass;
}

void add_fit_options(CommandLine& verb, TrackOptions& options) {
  verb.option("--name", options.fit.name, "of the track; default: the file's");
  verb.option("--smooth", options.fit.smoothing_m,
              "detail of the line that is shorter goes, m; default 30")
      .range(2.0, 200.0);
  verb.option("--knots", options.fit.knot_spacing_m, "step of the track file, m; default 5")
      .range(1.0, 50.0);
  verb.option("--datum", options.datum, "LAT,LON,HEIGHT of the CSV's origin: degrees, degrees, m")
      .with_commas()
      .words(3);
}

}  // namespace

int track_verb(std::span<const std::string> args) {
  TrackOptions options;
  CommandLine app{"pitwall-hil track: any team's track, read, checked and looked at"};
  CommandLine checks =
      app.one_of("check", "length, closure, curvature, widths, banking, what is odd");
  checks.option("FILE", options.file, "track file (.yaml) or CSV").required();
  checks.option("--json", options.json_file, "write the figures here");
  CommandLine imports = app.one_of("import", "a track file of a CSV");
  imports.option("CSV", options.file, "x_m,y_m,w_tr_right_m,w_tr_left_m and more").required();
  imports.option("--out", options.out, "the track file (.yaml)").required();
  CommandLine pictures = app.one_of("picture", "the track from above, as SVG");
  pictures.option("FILE", options.file, "track file (.yaml) or CSV").required();
  pictures.option("--out", options.out, "the picture (.svg)").required();
  for (CommandLine* verb : {&checks, &imports, &pictures}) add_fit_options(*verb, options);
  if (const auto code = app.ended_by(args)) return *code;
  if (checks.is_chosen()) return check(options);
  return imports.is_chosen() ? import_to(options) : picture(options);
}

}  // namespace pitwall::cli
