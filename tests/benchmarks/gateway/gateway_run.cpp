// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/gateway_run.hpp"

#include <charconv>
#include <csignal>
#include <optional>
#include <utility>

#include "protocol/json/json_text.hpp"
#include "protocol/transport/bench_clock/kept_clock.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::benchmarks {
namespace {

// The car (80) before the sender, the sender before those who look on.
constexpr int kSenderPriority = 70, kListenerPriority = 60;
constexpr Duration kListenLook = milliseconds(10);
constexpr Duration kGuestStartLimit = seconds(15), kGuestStopLimit = seconds(5);
constexpr Duration kLead = seconds(2);              // for the sender to start
constexpr Duration kSilence = milliseconds(1'600);  // longer than any period and its slack
constexpr Duration kPause = milliseconds(300);      // of the receiver with the small queue
constexpr std::int64_t kPauses = 3;

class Experiment {
 public:
  Experiment(const GatewayPlan& plan, const load::Traffic& traffic, load::Listener listener,
             load::QueueProbe probe)
      : plan_(plan), traffic_(traffic), listener_(std::move(listener)), probe_(std::move(probe)) {}

  Result<GatewayRun, Problem> run() {
    if (auto problem = start_car()) return Unexpected{*problem};
    start_ = transport::monotonic_now() + kLead;
    if (auto problem = start_sender()) return Unexpected{*problem};
    listen_until(start_ + traffic_.length() + kSilence);
    if (auto problem = stop()) return Unexpected{*problem};
    judge();
    return out_;
  }

 private:
  void share_clock(std::vector<std::string>& argv) const {
    if (!plan_.clock.empty()) argv.insert(argv.end(), {"--clock", plan_.clock});
  }
  std::string summary_file() const { return plan_.folder + "/vehicle.json"; }
  std::string figures_file() const { return plan_.folder + "/sender.json"; }

  std::optional<Problem> start_car() {
    std::vector<std::string> argv = plan_.vehicle;
    argv.insert(argv.end(),
                {"--can", plan_.interface, "--summary", summary_file(), "--simulation"});
    share_clock(argv);
    auto vehicle = transport::Process::spawn({.argv = argv});
    if (!vehicle) return vehicle.error();
    vehicle_.emplace(*std::move(vehicle));
    const Instant limit = transport::monotonic_now() + kGuestStartLimit;
    while (transport::monotonic_now() < limit && !vehicle_->poll()) {
      listener_.poll();
      if (listener_.counts().others > 0) return std::nullopt;
      transport::sleep_until(transport::monotonic_now() + kListenLook);
    }
    return Problem{plan_.vehicle.front(), "no frame of the car on " + plan_.interface};
  }

  std::optional<Problem> start_sender() {
    std::vector<std::string> argv = plan_.sender;
    argv.insert(argv.end(), {"--start", std::to_string(start_.ns), "--figures", figures_file()});
    share_clock(argv);
    auto sender = transport::Process::spawn({.argv = argv});
    if (!sender) return sender.error();
    sender_.emplace(*std::move(sender));
    return std::nullopt;
  }

  // The small queue pauses a few times in the middle, and over the end of the traffic.
  bool pausing(Instant now) const {
    const Duration since = now - start_, step = traffic_.length() / (kPauses + 1);
    for (std::int64_t i = 1; i <= kPauses; ++i)
      if (since >= i * step && since < i * step + kPause) return true;
    return since >= traffic_.length() - kPause && since < traffic_.length() + kPause;
  }

  void listen_until(Instant end) {
    for (Instant due = transport::monotonic_now() + kListenLook; due < end; due += kListenLook) {
      transport::sleep_until(due);
      const Instant now = transport::monotonic_now();
      if (now >= start_) late_us_.push_back(static_cast<double>((now - due).ns) * 1e-3);
      listener_.poll();
      if (pausing(now) != paused_) {
        paused_ = !paused_;
        paused_ ? probe_.pause() : probe_.resume();
      }
      probe_.poll();
    }
  }

  std::optional<Problem> stop() {
    const Instant limit = transport::monotonic_now() + kGuestStopLimit;
    const auto sent = sender_->wait_until(limit);
    if (!sent || !sent->success()) return Problem{plan_.sender.front(), "the sender failed"};
    vehicle_->kill(SIGTERM);
    if (!vehicle_->wait_until(limit))
      return Problem{plan_.vehicle.front(), "the car process did not stop"};
    if (auto problem = read_figures()) return problem;
    auto car = bench::read_car_summary(summary_file());
    if (!car) return car.error();
    out_.car = *std::move(car);
    return std::nullopt;
  }

  std::optional<Problem> read_figures() {
    const auto document = yaml::load_file(figures_file());
    if (!document) return document.error();
    const auto figures = yaml::read(*document, [](yaml::StrictMap& map) {
      constexpr std::int64_t kMost = 1'000'000'000'000;
      load::SenderFigures sender;
      sender.sent = static_cast<std::uint64_t>(map.integer("sent", 0, kMost));
      sender.offered_again = static_cast<std::uint64_t>(map.integer("offered_again", 0, kMost));
      sender.late = {.p50_us = map.number("late_p50_us", 0.0, 1e12),
                     .p99_us = map.number("late_p99_us", 0.0, 1e12),
                     .max_us = map.number("late_max_us", 0.0, 1e12)};
      for (const std::string& at : map.texts("omitted_at_ns", 0, kMost)) {
        std::int64_t ns = 0;
        std::from_chars(at.data(), at.data() + at.size(), ns);
        sender.omitted_at.push_back({ns});
      }
      return sender;
    });
    if (!figures) return figures.error();
    if (figures->omitted_at.size() != traffic_.omissions().size())
      return Problem{figures_file(), "the sender left out something else"};
    out_.sender = *figures;
    return std::nullopt;
  }

  std::uint64_t numbered_sent() const {
    std::uint64_t numbered = 0;
    for (std::size_t i = 0; i < traffic_.streams().size(); ++i)
      if (load::is_numbered(traffic_.streams()[i].row.id)) numbered += traffic_.sent(i);
    return numbered;
  }

  void judge() {
    std::vector<can::LossReport> reports;
    for (const world::LossReport& loss : out_.car.losses) {
      if (loss.id == 0) continue;  // of the queue or the interface: judged by their counts
      reports.push_back({.id = loss.id,
                         .sign = loss.detector == world::LossDetector::kCounter
                                     ? can::LossSign::kCounter
                                     : can::LossSign::kPeriod,
                         .frames = loss.frames,
                         .due = loss.due,
                         .noticed = loss.noticed});
    }
    out_.by_car = load::judge_losses(traffic_, {.omitted_at = out_.sender.omitted_at,
                                                .reports = reports,
                                                .arrivals = listener_.arrivals(),
                                                .of_car_only = true});
    out_.by_listener = load::judge_losses(traffic_, {.omitted_at = out_.sender.omitted_at,
                                                     .reports = listener_.reports(),
                                                     .arrivals = listener_.arrivals()});
    probe_.settle_trailing(numbered_sent());
    out_.queue = probe_.losses();
    out_.sent = traffic_.sent();
    out_.sent_of_car = traffic_.sent_of_car();
    out_.listener = listener_.counts();
    out_.listener_lost_in_queue = listener_.lost_in_queue();
    out_.wake = load::lateness_of(late_us_);
  }

  const GatewayPlan& plan_;
  const load::Traffic& traffic_;
  load::Listener listener_;
  load::QueueProbe probe_;
  std::optional<transport::Process> vehicle_, sender_;
  Instant start_{};
  bool paused_ = false;
  std::vector<double> late_us_;
  GatewayRun out_;
};

}  // namespace

Result<GatewayRun, Problem> run_gateway(const GatewayPlan& plan) {
  const load::Traffic traffic{plan.traffic};
  auto listener = load::Listener::open(plan.interface, traffic);
  if (!listener) return Unexpected{listener.error()};
  auto probe = load::QueueProbe::open(plan.interface);
  if (!probe) return Unexpected{probe.error()};
  std::optional<transport::KeptClock> clock;
  if (!plan.clock.empty()) {
    auto kept = transport::KeptClock::keep(plan.clock);
    if (!kept) return Unexpected{kept.error()};
    clock.emplace(*std::move(kept));
    if (const auto taken = transport::take_turns(); !taken) return Unexpected{taken.error()};
  }
  transport::request_realtime(kListenerPriority);
  return Experiment{plan, traffic, *std::move(listener), *std::move(probe)}.run();
}

Result<load::SenderFigures, Problem> send_traffic(const std::string& interface,
                                                  const load::TrafficPlan& plan, Instant start,
                                                  const std::string& figures_file) {
  load::Traffic traffic{plan};
  // It hears nothing: its queue would only fill.
  auto bus = transport::CanSocket::open(
      interface, {.filters = {{.id = 0, .mask = can::kMaxExtendedId, .extended = true}},
                  .receive_errors = false});
  if (!bus) return Unexpected{bus.error()};
  if (const auto taken = transport::take_turns(); !taken) return Unexpected{taken.error()};
  transport::request_realtime(kSenderPriority);
  const load::SenderFigures figures = load::send(*bus, traffic, start);
  // A file goes to the host's disk, and the whole guest waits for it: not while others listen.
  transport::sleep_until(start + plan.length + kSilence);
  json::Array omitted;
  for (const Instant at : figures.omitted_at) omitted.text(std::to_string(at.ns));
  const auto written =
      transport::write_file(figures_file, json::Object{}
                                                  .number("sent", figures.sent)
                                                  .number("offered_again", figures.offered_again)
                                                  .number("late_p50_us", figures.late.p50_us)
                                                  .number("late_p99_us", figures.late.p99_us)
                                                  .number("late_max_us", figures.late.max_us)
                                                  .json("omitted_at_ns", omitted.str())
                                                  .str() +
                                              "\n");
  if (!written) return Unexpected{written.error()};
  return figures;
}

}  // namespace pitwall::benchmarks
