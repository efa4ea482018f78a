// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/protocol_comparison/comparison.hpp"

#include <fcntl.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "hil/link/trace.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/vocabulary/quantile.hpp"
#include "tests/benchmarks/radio/age_samples.hpp"
#include "tests/benchmarks/radio/rate_window.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr std::uint32_t kCarIp = 0x0A4D0001, kBaseIp = 0x0A4D0002;  // 10.77.0.1, 10.77.0.2
constexpr Duration kTimeout = seconds(5);                           // beyond the end
constexpr const char *kCar = "car", *kBase = "base";
constexpr double kBitsPerByte = 8.0;

double kbps(double bytes, Duration over) { return bytes * kBitsPerByte / over.seconds() * 1e-3; }

link::LinkTrace shifted(link::LinkTrace trace, Duration by) {
  for (link::Outage& outage : trace.outages) {
    outage.from += by;
    outage.to += by;
  }
  return trace;
}

std::vector<std::string> words_of(const Peer& contestant, const char* role, Instant end,
                                  bool bulk) {
  std::vector<std::string> words{contestant.program, role, std::to_string(end.ns),
                                 bulk ? "1" : "0"};
  if (!contestant.mode.empty()) words.push_back(contestant.mode);
  return words;
}

// A process inside a network, its standard output into a file.
Result<transport::Process, Problem> start(const transport::TunNetwork& network,
                                          std::vector<std::string> words,
                                          const std::string& output) {
  const auto opened = transport::posix_call(
      [&] { return ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644); });
  const transport::FileDescriptor file(opened);
  if (!file.valid()) return Unexpected{Problem{output, opened.reason()}};
  std::optional<Result<transport::Process, Problem>> started;
  const auto done = network.inside([&] {
    started.emplace(transport::Process::spawn(
        {.argv = std::move(words), .descriptors = {{file.get(), 1}}, .own_group = true}));
  });
  if (!done) return Unexpected{done.error()};
  return *std::move(started);
}

Result<bool, Problem> await(transport::Process& process, const std::string& name, Instant until) {
  const auto ended = process.wait_until(until);
  if (!ended) return Unexpected{Problem{name, "did not end in time"}};
  if (!ended->success())
    return Unexpected{Problem{name, "ended with " + std::to_string(ended->shell_code())}};
  return true;
}

// Times since the start of the link.
Result<Arrivals, Problem> arrivals_in(const std::string& file, const std::string& name,
                                      Instant begin) {
  const auto text = transport::read_file(file);
  if (!text) return Unexpected{text.error()};
  auto arrivals = read_arrivals(*text, name);
  if (!arrivals) return arrivals;
  for (StateArrival& arrival : arrivals->states) {
    arrival.made = Instant{} + (arrival.made - begin);
    arrival.at = Instant{} + (arrival.at - begin);
  }
  for (BulkArrival& arrival : arrivals->bulk) arrival.at = Instant{} + (arrival.at - begin);
  return arrivals;
}

struct Networks {
  transport::TunNetwork car, base;
};

Result<Networks, Problem> make_networks() {
  auto car = transport::TunNetwork::create({.address = kCarIp});
  if (!car) return Unexpected{car.error()};
  auto base = transport::TunNetwork::create({.address = kBaseIp});
  if (!base) return Unexpected{base.error()};
  return Networks{*std::move(car), *std::move(base)};
}

// A line; none: it is no such line.
std::optional<StateArrival> arrival_of(std::string_view line) {
  StateArrival arrival;
  const char* const end = line.data() + line.size();
  const auto [made_end, made_error] = std::from_chars(line.data(), end, arrival.made.ns);
  if (made_error != std::errc{} || made_end == end || *made_end != ' ') return std::nullopt;
  const auto [at_end, at_error] = std::from_chars(made_end + 1, end, arrival.at.ns);
  if (at_error != std::errc{}) return std::nullopt;
  if (at_end == end) return arrival;
  arrival.stream.assign(at_end + 1, end);
  if (*at_end != ' ' || arrival.stream.empty()) return std::nullopt;
  return arrival;
}

std::optional<BulkArrival> bulk_of(std::string_view line) {
  constexpr std::string_view kBulk = "bulk ";
  BulkArrival arrival;
  if (!line.starts_with(kBulk)) return std::nullopt;
  const char* const end = line.data() + line.size();
  const auto [at_end, at_error] = std::from_chars(line.data() + kBulk.size(), end, arrival.at.ns);
  if (at_error != std::errc{} || at_end == end || *at_end != ' ') return std::nullopt;
  const auto [bytes_end, bytes_error] = std::from_chars(at_end + 1, end, arrival.bytes);
  if (bytes_error != std::errc{} || bytes_end != end) return std::nullopt;
  return arrival;
}

std::vector<std::vector<StateArrival>> by_stream(std::vector<StateArrival> arrivals) {
  std::vector<std::vector<StateArrival>> streams;
  for (StateArrival& arrival : arrivals) {
    const auto same = [&](const auto& s) { return s.front().stream == arrival.stream; };
    const auto known = std::ranges::find_if(streams, same);
    (known == streams.end() ? streams.emplace_back() : *known).push_back(std::move(arrival));
  }
  if (streams.empty()) streams.emplace_back();
  return streams;
}

double late_p99_ms(std::vector<Duration> late) {
  if (late.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(nearest_rank(0.99, late.size()));
  std::nth_element(late.begin(), late.begin() + rank, late.end());
  return late[static_cast<std::size_t>(rank)].milliseconds();
}

}  // namespace

Result<Arrivals, Problem> read_arrivals(std::string_view text, const std::string& name) {
  Arrivals arrivals;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    auto state = arrival_of(text.substr(0, end));
    const auto bulk = bulk_of(text.substr(0, end));
    if (end == std::string_view::npos || (!state && !bulk))
      return Unexpected{Problem{name + ":" + std::to_string(line),
                                "expected MADE_NS ARRIVED_NS [STREAM] or bulk ARRIVED_NS BYTES"}};
    if (state) arrivals.states.push_back(*std::move(state));
    if (bulk) arrivals.bulk.push_back(*bulk);
    text.remove_prefix(end + 1);
  }
  std::ranges::stable_sort(arrivals.states, {}, &StateArrival::at);
  return arrivals;
}

ComparisonRow judge(const Arrivals& arrivals, const LinkTally& tally, const ComparisonPlan& plan) {
  const Instant from = Instant{} + plan.warm_up, to = from + plan.length;
  const auto judged = [&](Instant at) { return at >= from && at < to; };
  link::AgeSamples ages(from, to);
  for (const StateArrival& arrival : arrivals.states) ages.arrived(arrival.made, arrival.at);
  ages.finish();
  std::size_t bulk_bytes = 0;
  for (const BulkArrival& arrival : arrivals.bulk) {
    if (judged(arrival.at)) bulk_bytes += arrival.bytes;
  }
  link::RateWindow down(kRateWindow), up(kRateWindow), down_long(kLongWindow);
  const auto add = [&](link::RateWindow& window, const DirectionTally& direction) {
    for (const OfferedPacket& packet : direction.offered)
      if (judged(packet.at)) window.sent(packet.bytes, packet.at);
  };
  add(down, tally.down);
  add(down_long, tally.down);
  add(up, tally.up);
  return {.contestant = {},
          .stream = arrivals.states.empty() ? "" : arrivals.states.front().stream,
          .of_case = {},
          .age_p50_ms = ages.quantile_ms(0.5),
          .age_p99_ms = ages.quantile_ms(0.99),
          .age_max_ms = ages.max_ms(),
          .offered_kbps = kbps(static_cast<double>(down.bytes()), plan.length),
          .up_kbps = kbps(static_cast<double>(up.bytes()), plan.length),
          .worst_window_kbps = kbps(static_cast<double>(down.worst_bytes()), kRateWindow),
          .worst_second_kbps = kbps(static_cast<double>(down_long.worst_bytes()), kLongWindow),
          .bulk_kbps = kbps(static_cast<double>(bulk_bytes), plan.length),
          .states = arrivals.states.size(),
          .looks_without = ages.unknown(),
          .link_late_p99_ms = late_p99_ms(tally.down.late)};
}

link::LinkParams link_of(const ComparisonCase& of_case, const ComparisonPlan& plan) {
  link::LinkParams link = plan.link;
  if (of_case.fades) link.trace = shifted(plan.fades, plan.warm_up);
  if (of_case.queue > Duration{}) {
    link.queue_bytes = static_cast<std::size_t>(link.rate_bytes_per_s * of_case.queue.seconds());
  }
  return link;
}

ComparisonRow best_possible(const ComparisonCase& of_case, const ComparisonPlan& plan) {
  const link::LinkTrace fades = link_of(of_case, plan).trace;
  Arrivals arrivals;
  const Instant end = Instant{} + plan.warm_up + plan.length;
  for (Instant at{}; at < end; at += link::kSamplePeriod)
    if (link::loss_over_time(fades, at) == 0.0)
      arrivals.states.push_back({at, at + plan.link.delay});
  ComparisonRow row = judge(arrivals, {}, plan);
  row.contestant = "the channel's floor";
  row.of_case = of_case.name;
  return row;
}

Result<std::vector<ComparisonRow>, Problem> run_comparison(const Peer& contestant,
                                                           const ComparisonCase& of_case,
                                                           const ComparisonPlan& plan) {
  auto networks = make_networks();
  if (!networks) return Unexpected{networks.error()};
  const auto folder = transport::TemporaryFolder::create("pitwall-comparison");
  if (!folder) return Unexpected{folder.error()};
  const link::LinkParams params = link_of(of_case, plan);
  const Instant begin = transport::monotonic_now(), end = begin + plan.warm_up + plan.length;
  TunLink radio(networks->car, networks->base, params, params, plan.seed, begin);
  const auto run = [&](const transport::TunNetwork& network, const char* role) {
    return start(network, words_of(contestant, role, end, of_case.bulk),
                 folder->path() + "/" + role);
  };
  auto base = run(networks->base, kBase);
  if (!base) return Unexpected{base.error()};
  auto car = run(networks->car, kCar);
  if (!car) return Unexpected{car.error()};
  for (transport::Process* process : {&*car, &*base})
    if (const auto ended = await(*process, contestant.name, end + kTimeout); !ended)
      return Unexpected{ended.error()};
  const LinkTally& tally = radio.stop();
  auto arrivals = arrivals_in(folder->path() + "/" + kBase, contestant.name, begin);
  if (!arrivals) return Unexpected{arrivals.error()};

  std::vector<ComparisonRow> rows;
  for (auto& stream : by_stream(std::move(arrivals->states))) {
    ComparisonRow row = judge({std::move(stream), arrivals->bulk}, tally, plan);
    row.contestant = contestant.name;
    row.of_case = of_case.name;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace pitwall::benchmarks
