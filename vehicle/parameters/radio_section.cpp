// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/parameters/car_file.hpp"

namespace pitwall::parameters {
namespace {

constexpr double kLeastShare_bytes_per_s = 1'000.0;  // a packet of safety alone, ten times a second
constexpr double kMost_bytes_per_s = 1'250'000.0;    // 10 Mbit/s

void read_paths(yaml::StrictMap& map, pipeline::RadioParams& radio) {
  constexpr std::size_t n = pipeline::kRadioPathsMax;
  const auto bytes = map.numbers("bytes_per_s", n, n, 8'000.0, kMost_bytes_per_s);
  const auto packets = map.numbers("packets_per_s", n, n, 10.0, 1'000.0);
  const auto safety =
      map.numbers("safety_bytes_per_s", n, n, kLeastShare_bytes_per_s, kMost_bytes_per_s);
  for (std::size_t i = 0; i < n; ++i) {
    if (safety[i] >= bytes[i]) map.fail("safety_bytes_per_s", "must be below bytes_per_s");
    const bool fits = radio.paths.push({bytes[i], packets[i], safety[i]});
    CHECK(fits);
  }
}

void read_link_loss(yaml::StrictMap map, Duration lost, safety::LinkLossParams& link_loss) {
  const auto time = [&](const char* key, double min_s, Duration above, const char* what) {
    const Duration at = from_seconds(map.number(key, min_s, 60.0));
    if (at <= above) map.fail(key, std::string{"must be above "} + what);
    return at;
  };
  link_loss.joystick_dropped = time("joystick_dropped_s", 0.05, Duration{}, "0");
  link_loss.override_gone =
      time("override_gone_s", 0.05, link_loss.joystick_dropped, "joystick_dropped_s");
  link_loss.no_comm = time("no_comm_s", 0.05, link_loss.override_gone, "override_gone_s");
  if (link_loss.no_comm >= lost) map.fail("no_comm_s", "must be below safety.watchdog.radio.bad_s");
  link_loss.no_comm_drives = map.flag("no_comm_drives");
  link_loss.no_comm_speed_mps = map.number("no_comm_speed_mps", 1.0, 120.0);
}

}  // namespace

void read_radio(yaml::StrictMap map, pipeline::CarParams& params) {
  read_paths(map, params.radio);
  params.radio.signed_only = map.flag("signed_only");
  const Duration lost = params.watchdog[safety::Stream::kRadio].bad;
  read_link_loss(map.map("ladder"), lost, params.radio.link_loss);
}

}  // namespace pitwall::parameters
