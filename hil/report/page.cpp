// SPDX-License-Identifier: Apache-2.0
#include "hil/report/page.hpp"

#include "hil/report/contact_section.hpp"
#include "hil/report/ground_charts.hpp"
#include "hil/report/html.hpp"
#include "hil/report/tables.hpp"
#include "hil/report/time_charts.hpp"

namespace pitwall::report {
namespace {

constexpr std::string_view kNoLine =
    "In a match the car changes lines: its error from its first one is not judged.";

}  // namespace

std::string page(const RunData& run, const world::TrackMap* track, const std::string& no_walls) {
  const grading::CrossTrack statistics = cross_track_of(run);
  std::string out = header(run) + banner(run);
  out += section("Expectations", verdict_table(run));
  const bool is_match = run.result && run.result->match;
  if (is_match) out += section("Match sheet", match_table(*run.result->match));
  if (run.contact) out += section("Contact with another car", contact_section(run));
  out += section(
      "Where, and how far from the line",
      beside(map_chart(run, track, no_walls),
             is_match ? note(kNoLine) : bracket_chart(statistics) + bracket_table(statistics)));
  out += section("Over time",
                 note("Point at a plot: every plot and the map show that moment. Shaded: a fault "
                      "is active.") +
                     time_charts(run));
  out += section("Lap and grip", beside(station_chart(run), acceleration_chart(run)));
  out += section("Timing", real_time_charts(run) + message_table(run));
  out += section("Figures", figures_table(run));
  out += section("Events", event_table(run));
  out += section("Losses", loss_table(run));
  return document(run.facts.scenario + " " + name_of(run.outcome()), out);
}

}  // namespace pitwall::report
