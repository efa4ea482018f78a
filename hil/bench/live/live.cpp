// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/live.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "hil/bench/live/live_car.hpp"
#include "hil/bench/live/wake_clock.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::bench {
namespace {

constexpr int kPriority = 60;  // below the car, which must never wait for its bench
constexpr Duration kStopLimit = seconds(5);
constexpr Duration kSettle = milliseconds(300);  // for frames and datagrams on their way
constexpr Duration kWake = LiveCar::kWake;
constexpr Duration kPollPeriod = milliseconds(10);
constexpr Duration kCarry = milliseconds(2);  // how often the radio is served

class Live {
 public:
  Live(std::unique_ptr<LiveCar> car, Duration duration, std::optional<BenchTime> time)
      : car_(std::move(car)), duration_(duration), clock_(kWake, duration, std::move(time)) {}

  Result<LiveResult, Problem> run() {
    if (auto problem = car_->start()) return Unexpected{*problem};
    const Instant begun = transport::wall_now();
    clock_.start();
    car_->begin(clock_.started());
    for (Instant now = Instant{} + kWake; now - Instant{} <= duration_; now += kWake) {
      clock_.sleep_until(now);
      car_->step(now);
      if (auto problem = car_->act(now)) return Unexpected{*problem};
      if ((now - Instant{}).ns % kCarry.ns == 0) car_->serve_radio(now);
      if ((now - Instant{}).ns % kPollPeriod.ns != 0) continue;
      if (auto problem = car_->look(now)) return Unexpected{*problem};
      if (!car_->is_over()) continue;
      car_->end(now);
      break;
    }
    clock_.end();
    return finish((transport::wall_now() - begun).seconds());
  }

 private:
  void settle(Duration span) {
    const Instant until = transport::monotonic_now() + span;
    while (transport::monotonic_now() < until) {
      car_->settle();
      transport::sleep_until(transport::monotonic_now() + milliseconds(2));
    }
  }

  Result<LiveResult, Problem> finish(double wall_s) {
    settle(kSettle);
    if (auto problem = car_->stop_processes(kStopLimit, [this] { settle(milliseconds(10)); }))
      return Unexpected{*problem};
    settle(kSettle);
    return car_->finish(clock_.report(), wall_s);
  }

  std::unique_ptr<LiveCar> car_;
  Duration duration_;
  WakeClock clock_;
};

}  // namespace

Result<LiveResult, Problem> run_live(const scenario::Scenario& scenario,
                                     const pipeline::Setup& setup, const LivePlan& plan) {
  auto car = LiveCar::open(scenario, setup, plan);
  if (!car) return Unexpected{car.error()};
  auto time = BenchTime::of_run(plan.clock, plan.clock_line);
  if (!time) return Unexpected{time.error()};
  transport::request_realtime(kPriority);
  return Live{*std::move(car), scenario.duration, *std::move(time)}.run();
}

}  // namespace pitwall::bench
