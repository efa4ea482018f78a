// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/tracking_table.hpp"

#include <algorithm>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::tracking_bench {
namespace {

const TrackingRow* ours(const std::vector<TrackingRow>& rows, const std::string& scene) {
  const auto found = std::ranges::find_if(
      rows, [&](const TrackingRow& r) { return r.scene == scene && r.method == "road"; });
  return found == rows.end() ? nullptr : &*found;
}

// NaN holds nothing.
Gate at_most(std::string name, double figure, double bound, const char* unit) {
  return {std::move(name), formatted("%.3g of %g %s", figure, bound, unit), figure <= bound};
}

Gate at_least(std::string name, double figure, double bound) {
  return {std::move(name), formatted("%.4f, at least %g", figure, bound), figure >= bound};
}

Gate none(std::string name, std::size_t count, bool is_measured) {
  return {std::move(name), formatted("%zu", count), count == 0 && is_measured};
}

void add_race(const TrackingRow& r, std::vector<Gate>& gates) {
  gates.push_back(at_most("race: position within 60 m", r.by_distance[kNear].position.value(),
                          kNearRms_m, "m rms"));
  gates.push_back(
      at_most("race: position at 100 m", r.by_distance[kFar].position.value(), kFarRms_m, "m rms"));
  gates.push_back(at_most("race: speed", r.speed.value(), kSpeedRms_mps, "m/s rms"));
  gates.push_back(none("race: no identity switch", r.switches, r.objects > 0));
  gates.push_back(at_least("race: MOTA", r.mota, kMota));
  gates.push_back(at_least("race: errors within the ellipsoid of 95 %", r.within_95(), kWithin95));
  gates.push_back(at_least("race: mean NEES of 4", r.nees_mean(), kNeesMean));
}

json::Object rms_json(const DistanceErrors& d) {
  json::Object json;
  json.number("position_rms_m", d.position.value())
      .number("along_rms_m", d.along.value())
      .number("across_rms_m", d.across.value())
      .number("map_rms_m", d.in_map.value())
      .number("speed_rms_mps", d.speed.value())
      .number("yaw_rms_rad", d.yaw.value())
      .number("samples", d.position.count);
  return json;
}

std::string row_json(const TrackingRow& r) {
  json::Array distances;
  for (std::size_t i = 0; i < r.by_distance.size(); ++i)
    distances.json(rms_json(r.by_distance[i])
                       .number("from_m", kDistances_m[i])
                       .number("to_m", kDistances_m[i + 1])
                       .str());
  return json::Object{}
      .text("scene", r.scene)
      .text("method", r.method)
      .json("distances", distances.str())
      .number("speed_rms_mps", r.speed.value())
      .number("nees_mean", r.nees_mean())
      .number("within_95", r.within_95())
      .number("mota", r.mota)
      .number("objects", r.objects)
      .number("misses", r.misses)
      .number("false_tracks", r.false_tracks)
      .number("switches", r.switches)
      .number("switches_hidden", r.switches_hidden)
      .number("out_of_sight", r.reborn)
      .number("passes", r.passes)
      .number("blind_times", r.blind_times)
      .number("blind_lost", r.blind_lost)
      .number("blind_worst_m", r.blind_worst_m)
      .number("frames", r.frames)
      .number("frames_refused", r.frames_refused)
      .number("frames_overtaken", r.frames_overtaken)
      .str();
}

std::string row_text(const TrackingRow& r) {
  std::string text = formatted("%-6s %-6s", r.scene.c_str(), r.method.c_str());
  for (const DistanceErrors& d : r.by_distance)
    text +=
        formatted("  %5.3f %5.3f %5.3f", d.position.value(), d.across.value(), d.in_map.value());
  text += formatted("  %6.3f %6.2f %6.3f %7.4f %5zu %6zu %7zu %6zu", r.speed.value(), r.nees_mean(),
                    r.within_95(), r.mota, r.switches, r.misses, r.false_tracks, r.passes);
  if (r.blind_times > 0)
    text += formatted("  %.2f m, %zu of %zu lost", r.blind_worst_m, r.blind_lost, r.blind_times);
  return text + '\n';
}

}  // namespace

std::vector<Gate> gates_of(const std::vector<TrackingRow>& rows, const OrdersResult& orders) {
  std::vector<Gate> gates;
  const TrackingRow missing;
  const TrackingRow* const race = ours(rows, "race");
  add_race(race ? *race : missing, gates);
  const TrackingRow* const pair = ours(rows, "pair");
  const TrackingRow& p = pair ? *pair : missing;
  gates.push_back(none("pair: no identity switch", p.switches, p.objects > 0));
  gates.push_back(at_least("pair: MOTA", p.mota, kMota));
  const TrackingRow* const blind = ours(rows, "blind");
  const TrackingRow& b = blind ? *blind : missing;
  gates.push_back(at_most("blind: error after 1.5 s", b.blind_times > 0 ? b.blind_worst_m : kUnset,
                          kBlind_m, "m"));
  gates.push_back(none("blind: no car lost", b.blind_lost, b.blind_times > 0));
  gates.push_back(at_most(formatted("%zu orders of arrival: largest difference", orders.orders),
                          orders.cars > 0 ? orders.worst : kUnset, kOrders, ""));
  return gates;
}

std::string to_text(const std::vector<TrackingRow>& rows) {
  std::string text =
      "SIMULATION. Errors in our car's axes; errors of our own place 0.03 m per axis, 0.1 deg.\n"
      "position rms, m: distance, across, in Map; speed rms, m/s; NEES of 4; share within 95 %\n" +
      formatted("%-6s %-6s  %-17s  %-17s  %-17s  %6s %6s %6s %7s %5s %6s %7s %6s  %s\n", "scene",
                "method", "0 to 60 m", "60 to 90 m", "90 to 110 m", "speed", "NEES", "95 %", "MOTA",
                "IDS", "missed", "false", "passes", "blind for 1.5 s");
  for (const TrackingRow& row : rows) text += row_text(row);
  for (const TrackingRow& r : rows)
    text += formatted(
        "%s, %s: %zu frames, %zu overtaken by a younger one, %zu refused; %zu times a car was out "
        "of sight for %.0f s; of %zu switches %zu within %.0f s after %.1f s behind other cars\n",
        r.scene.c_str(), r.method.c_str(), r.frames, r.frames_overtaken, r.frames_refused, r.reborn,
        kForgotten_s, r.switches, r.switches_hidden, kBack_s, kHidden_s);
  return text;
}

std::string to_text(const std::vector<Gate>& gates) {
  std::string text;
  for (const Gate& gate : gates)
    text += formatted("gate: %s: %s; %s\n", gate.name.c_str(), gate.held ? "held" : "MISSED",
                      gate.figure.c_str());
  return text;
}

std::string to_json(const std::vector<TrackingRow>& rows) {
  json::Array listed;
  for (const TrackingRow& row : rows) listed.json(row_json(row));
  return listed.str();
}

std::string to_json(const std::vector<Gate>& gates) {
  json::Array listed;
  for (const Gate& gate : gates)
    listed.json(json::Object{}
                    .text("gate", gate.name)
                    .flag("held", gate.held)
                    .text("figure", gate.figure)
                    .str());
  return listed.str();
}

}  // namespace pitwall::tracking_bench
