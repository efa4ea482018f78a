// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/car_setup.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/raceline/bank_file.hpp"

namespace pitwall::parameters {
namespace {

constexpr std::string_view kTrackMark = "<track>";

std::string folder_with_slash(const std::string& path) {
  return path.substr(0, path.rfind('/') + 1);
}

std::string stem_of(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);
  return name.substr(0, name.rfind('.'));
}

}  // namespace

std::string bank_path(const CarFile& car, const world::TrackDescription& track) {
  std::string path = car.params.planning.line.bank;
  if (path.empty()) return path;
  if (const std::size_t at = path.find(kTrackMark); at != std::string::npos)
    path.replace(at, kTrackMark.size(), stem_of(track.source));
  return path.starts_with('/') ? path : folder_with_slash(car.source) + path;
}

raceline::BankParams bank_for(const pipeline::CarParams& car) {
  const double beside_m = car.planning.line.wall_clearance_m - 0.5 * car.width_m;
  return {.car_width_m = car.width_m, .clearance_m = beside_m + raceline::kExcessAllowed_m};
}

raceline::CarLimits limits_of(const pipeline::CarParams& car,
                              const envelope::EnvelopeTable& table) {
  const double ratio = car.outbound.steering_ratio;
  constexpr double kStanding_mps = 0.0;  // where the steering reaches furthest
  return {.width_m = car.width_m,
          .wheelbase_m = car.control.steering.bicycle.wheelbase_m,
          .steer_max_rad = from_deg(safety::steer_limit_deg(car.gate, kStanding_mps)) / ratio,
          .steer_rate_max_rad_per_s = from_deg(car.gate.steer_slew_deg_per_s) / ratio,
          .corner_speed_mps =
              [&table](double curvature_per_m, double bank_rad) {
                return table.corner_speed_mps(table.place(curvature_per_m, bank_rad));
              },
          .envelope = &table};
}

Result<std::optional<world::RacelineBank>, Problem> bank_of(const CarFile& car,
                                                            const world::TrackDescription& track,
                                                            const ReadFile& read_file) {
  const std::string path = bank_path(car, track);
  if (path.empty()) return std::optional<world::RacelineBank>{};
  const auto map = world::TrackMap::build(track);
  if (!map) return Unexpected{map.error()};
  const auto text = read_file(path);
  if (!text) return Unexpected{text.error()};
  if (text->size() > raceline::kMaxBankBytes) return refuse(path, "is too large for a bank");
  const envelope::EnvelopeTable table{envelope_of(car.params, *map)};
  auto bank = raceline::read_bank(*text, path, track, *map, limits_of(car.params, table));
  if (!bank) return Unexpected{bank.error()};
  return std::optional{*std::move(bank)};
}

Result<pipeline::Setup, Problem> set_up(const CarFile& car, const world::TrackDescription& track,
                                        const ReadFile& read_file) {
  const auto bank = bank_of(car, track, read_file);
  if (!bank) return Unexpected{bank.error()};
  if (!*bank) return pipeline::prepare(car.params, track);
  pipeline::CarParams params = car.params;
  params.planning.line.bank = bank_path(car, track);  // as found, for messages and recordings
  return pipeline::prepare(params, track, &**bank);
}

}  // namespace pitwall::parameters
