// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/burst_run.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "tests/benchmarks/radio/age_samples.hpp"
#include "tests/benchmarks/radio/offered_load.hpp"

namespace pitwall::radio {

using telemetry::Class;
using telemetry::Direction;
using telemetry::GroupRow;
using telemetry::kGroupTable;
using telemetry::PathId;

namespace {

constexpr double kRate = 32'000.0;  // 256 kbit/s
constexpr Duration kOneWay = milliseconds(15), kWarmUp = seconds(5), kOracleEvery = milliseconds(2);

RadioSetup setup_of(const BurstCase& c) {
  RadioSetup setup;
  setup.down.fill(link::bursty(c.loss, c.fade, kRate, kOneWay));
  setup.up = setup.down;
  setup.paths = c.paths;
  setup.seed = c.seed;
  return setup;
}

Duration quantile(const link::AgeSamples& ages, double q) {
  return from_seconds(ages.quantile_ms(q) * 1e-3);
}

double slow_p99(const VirtualRadio& radio) {
  double worst = 0.0;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != Direction::kDown || row.priority <= Class::kMotion) continue;
    const Duration target = std::max(row.target_age, seconds(1));
    worst = std::max(worst, radio.ages().quantile(row.group, 0.99).seconds() / target.seconds());
  }
  return worst;
}

}  // namespace

AgeQuantiles ages_of(const VirtualRadio& radio, Class priority) {
  AgeQuantiles oldest;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != Direction::kDown || row.priority != priority) continue;
    oldest.p50 = std::max(oldest.p50, radio.ages().quantile(row.group, 0.5));
    oldest.p99 = std::max(oldest.p99, radio.ages().quantile(row.group, 0.99));
    oldest.p999 = std::max(oldest.p999, radio.ages().quantile(row.group, 0.999));
  }
  return oldest;
}

AgeQuantiles state_ages_of(const VirtualRadio& radio) {
  const AgeMeter& ages = radio.ages();
  return {ages.state_quantile(0.5), ages.state_quantile(0.99), ages.state_quantile(0.999)};
}

// Something tiny on all paths, without a budget and without a queue.
AgeQuantiles oracle_of(const BurstCase& c) {
  const RadioSetup setup = setup_of(c);
  const Instant start = Instant{} + kWarmUp, end = start + c.length;
  link::AgeSamples ages(start, end);
  std::vector<std::unique_ptr<link::LinkEmulator>> air;
  for (PathId path = 0; path < setup.paths; ++path) {
    link::LinkParams params = setup.down[path];
    params.rate_bytes_per_s = 0.0;
    air.push_back(std::make_unique<link::LinkEmulator>(params, link_seed(setup.seed, path, true)));
  }
  const std::array<std::uint8_t, 4> tiny{};
  for (Instant now{}; now < end; now += kStep) {
    for (auto& path : air) {
      while (const auto datagram = path->take(now)) ages.arrived(datagram->offered, now);
      if (now.ns % kOracleEvery.ns == 0) path->offer(tiny, now);
    }
  }
  ages.finish();
  return {quantile(ages, 0.5), quantile(ages, 0.99), quantile(ages, 0.999)};
}

BurstRun run_burst(const BurstCase& c) {
  const RadioSetup setup = setup_of(c);
  BurstRun run;
  run.oracle = oracle_of(c);
  VirtualRadio radio(setup);
  OfferedLoad load(kRate, c.load);
  load.run(radio, kWarmUp);
  radio.reset_ages();
  load.run(radio, c.length);
  for (std::size_t i = 0; i < telemetry::kClasses; ++i) {
    run.classes[i] = ages_of(radio, static_cast<Class>(i));
  }
  run.slow_p99 = slow_p99(radio);
  run.rate_factor = radio.car_report().paths[0].rate_factor;
  run.content_errors = radio.content_errors();
  return run;
}

bool BurstRun::holds() const {
  const AgeQuantiles &safety = of(Class::kSafety), &motion = of(Class::kMotion);
  return safety.p99 <= oracle.p99 + milliseconds(45) &&
         safety.p999 <= oracle.p999 + milliseconds(60) &&
         motion.p99 <= oracle.p99 + milliseconds(60) &&
         motion.p999 <= oracle.p999 + milliseconds(60) && slow_p99 <= 1.2 &&
         content_errors.too_young == 0 && content_errors.never_sampled == 0;
}

std::string to_string(const BurstCase& c, const BurstRun& run) {
  const AgeQuantiles &safety = run.of(Class::kSafety), &motion = run.of(Class::kMotion);
  std::array<char, 240> text{};
  std::snprintf(text.data(), text.size(),
                "%2.0f %% of %3.0f ms, %d path%s, load %2.0fx, seed %2llu: oracle p99 %3.0f p99.9 "
                "%3.0f ms; safety +%.0f +%.0f; motion +%.0f +%.0f; slow %.2f of its time",
                c.loss * 100, c.fade.milliseconds(), c.paths, c.paths > 1 ? "s" : "", c.load,
                static_cast<unsigned long long>(c.seed), run.oracle.p99.milliseconds(),
                run.oracle.p999.milliseconds(), (safety.p99 - run.oracle.p99).milliseconds(),
                (safety.p999 - run.oracle.p999).milliseconds(),
                (motion.p99 - run.oracle.p99).milliseconds(),
                (motion.p999 - run.oracle.p999).milliseconds(), run.slow_p99);
  return text.data();
}

}  // namespace pitwall::radio
