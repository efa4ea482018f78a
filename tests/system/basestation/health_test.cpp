// What the console shows of a car that runs: its receivers one by one, its watchdogs, why it stops.
// A lockstep run's own telemetry goes over the radio's real endpoints into a real base station.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "basestation/publishers/text/text_view.hpp"
#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::publishers {
namespace {

constexpr double kLost_s = 30.0;  // the second receiver's cable

scenario::Scenario cable_cut(const bench::Loaded& lap) {
  scenario::Scenario out = lap.scenario;
  out.duration = seconds(40);
  scenario::Fault fault;
  fault.kind = "gnss_unit_outage", fault.unit = 1;
  fault.at = from_seconds(kLost_s), fault.lasts = seconds(60);
  out.faults = {fault};
  return out;
}

struct Screens {
  std::string driving, stopping;
};

Screens watch_run() {
  const std::string root = PITWALL_SOURCE_DIR;
  const auto lap = bench::load(root + "/hil/scenarios/lvms_flying_lap.yaml", root);
  EXPECT_TRUE(lap);
  RadioRig radio({.real_car = false});
  Screens screens;
  bench::LockstepOptions options;
  options.watch_telemetry = [&](const telemetry::Snapshot& snapshot, Instant now) {
    radio.now = std::max(radio.now, now - milliseconds(20));
    radio.snapshot = snapshot;
    for (; radio.now < now; radio.now += RadioRig::kTick) radio.step();
    const bool before = now - Instant{} < from_seconds(kLost_s);
    (before ? screens.driving : screens.stopping) = text_view(*radio.base, now, {});
  };
  radio.now = Instant{};
  const scenario::Scenario run = cable_cut(*lap);
  EXPECT_TRUE(bench::run_lockstep(run, lap->setup, options));
  return screens;
}

// The figure behind a name, of the receiver whose line comes first; -1 where there is none.
double figure(const std::string& screen, const std::string& receiver, const std::string& name) {
  const std::size_t at = screen.find(receiver + "   position");
  if (at == std::string::npos) return -1.0;
  std::smatch match;
  const std::string rest = screen.substr(at);
  if (!std::regex_search(rest, match, std::regex(name + " ([0-9.]+)"))) return -1.0;
  return std::stod(match[1]);
}

TEST(Health, TheConsoleShowsReceiversWatchdogsAndTheReasonOfAStop) {
  const Screens screens = watch_run();
  const auto shows = [](const std::string& screen, const std::string& text) {
    EXPECT_NE(screen.find(text), std::string::npos) << text << "\n" << screen;
  };
  // GIVEN a car that drives
  shows(screens.driving, "stop      no reason");
  shows(screens.driving, "watchdogs all streams are as they should be");
  for (const std::string unit : {"gnss0", "gnss1"}) {
    shows(screens.driving, unit + "   position: in use   velocity: in use");
    EXPECT_GE(figure(screens.driving, unit, "satellites"), 10.0) << screens.driving;
    EXPECT_EQ(figure(screens.driving, unit, "type"), 50.0);  // fixed by corrections
    EXPECT_LT(figure(screens.driving, unit, "sigma"), 0.05);
    EXPECT_GT(figure(screens.driving, unit, "logs"), 5'000.0);  // 29 s at some 200 a second
    EXPECT_EQ(figure(screens.driving, unit, "bad checksum"), 0.0);
    EXPECT_EQ(figure(screens.driving, unit, "refused"), 0.0);
  }
  // WHEN the second receiver's cable is cut
  // THEN the console says which stream is lost, that the car stops and why
  shows(screens.stopping, "stop      because: GNSS unit disconnected");
  shows(screens.stopping, "gnss1_link LOST");
  shows(screens.stopping, "gnss1_position LOST");
  EXPECT_EQ(screens.stopping.find("gnss0_link LOST"), std::string::npos) << screens.stopping;
  shows(screens.stopping, "gnss1   position: SILENT");
  EXPECT_GT(figure(screens.stopping, "gnss0", "bytes"),
            1.2 * figure(screens.stopping, "gnss1", "bytes"));
}

}  // namespace
}  // namespace pitwall::publishers
