// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/live_replay.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "hil/bench/live/bench_time.hpp"
#include "hil/bench/live/operator_line.hpp"
#include "hil/bench/live/process_supervisor.hpp"
#include "hil/bench/live/radio_path.hpp"
#include "hil/bench/recorded/operator_texts.hpp"
#include "hil/replay/socket_io.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/recorder/can_record.hpp"
#include "protocol/recorder/channels.hpp"
#include "protocol/recorder/tick_record.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::bench {
namespace {

using transport::CanSocket;

constexpr int kPriority = 60;  // as the live bench: below the car
constexpr Duration kStartLimit = seconds(15);
constexpr Duration kPollPeriod = milliseconds(1);   // bench time goes on at least so often
constexpr Duration kLookAgain = microseconds(200);  // at somebody who is held up
constexpr Duration kLookAtCar = milliseconds(10);
constexpr Duration kSettle = milliseconds(100);  // for the last ticks
constexpr std::array<const char*, recorder::kReceivers> kReceiverSources{"/gnss/0", "/gnss/1"};

// The radio to a base station of our own, and what its operator says.
class BaseSide {
 public:
  // Before the time at which the car had it: the way by the radio takes a packet's slot.
  static constexpr Duration kWay = milliseconds(20);

  BaseSide(RadioPath radio, std::vector<scenario::OperatorText> texts, const LivePlan& plan)
      : radio_(std::move(radio)), texts_(std::move(texts)), commands_(plan.command_socket()) {}

  void carry(Instant now) { radio_.serve(now); }
  void say(Duration in_run) {
    for (; next_ < texts_.size() && texts_[next_].at - kWay <= in_run; ++next_)
      commands_.send(texts_[next_].text);
  }

 private:
  RadioPath radio_;
  std::vector<scenario::OperatorText> texts_;
  OperatorLine commands_;
  std::size_t next_ = 0;
};

Result<BaseSide, Problem> open_base(const CommandTrace& recorded, const LivePlan& plan) {
  std::array<RadioPorts, 1> ports{plan.radio[0]};
  if (!plan.base.empty()) ports[0].onward = plan.base_port;
  auto radio = RadioPath::open(ports, RadioChannel{{}, {}, 0});
  if (!radio) return Unexpected{radio.error()};
  auto texts = with_authority(plan.has_base() ? recorded.operator_texts
                                              : std::vector<scenario::OperatorText>{});
  return BaseSide{*std::move(radio), std::move(texts), plan};
}

// Who waits for the next frame keeps bench time going meanwhile, and looks after the car.
class BenchIo {
 public:
  BenchIo(replay::SocketIo& sockets, ProcessSupervisor& processes, BaseSide base,
          std::optional<BenchTime> time)
      : sockets_(sockets), processes_(processes), base_(std::move(base)), time_(std::move(time)) {}

  void begin() {
    if (time_) time_->begin();
  }
  void start(Instant first_tick) { first_tick_ = first_tick; }
  void end() {
    if (time_) time_->end();
  }
  Instant now() { return transport::monotonic_now(); }
  void wait_until(Instant deadline) {
    for (Instant at = now(); at < deadline && !stopped(); at = now()) {
      look(at);
      const Duration left = std::min(deadline - at, kPollPeriod);
      if (!time_) {
        transport::sleep_until(at + left);
        continue;
      }
      const bool goes = time_->advance(deadline + transport::ClockKeeper::kLead, at);
      transport::nap(goes ? left : std::max(left, kLookAgain));
    }
  }
  replay::TrackOutcome send(std::size_t track, std::size_t first, std::size_t count) {
    return sockets_.send(track, first, count);
  }
  bool stopped() const { return sockets_.stopped() || missing_; }
  const std::optional<Problem>& missing() const { return missing_; }
  std::optional<transport::ClockWaits> waits() const {
    return time_ ? std::optional{time_->waits()} : std::nullopt;
  }

 private:
  void look(Instant at) {
    base_.carry(at);
    if (first_tick_) base_.say(at - *first_tick_);
    if (at - polled_at_ < kLookAtCar) return;
    polled_at_ = at;
    sockets_.now();
    sockets_.wait_until(at);  // has passed: it looks for a signal, nothing else
    missing_ = processes_.missing();
  }

  replay::SocketIo& sockets_;
  ProcessSupervisor& processes_;
  BaseSide base_;
  std::optional<BenchTime> time_;
  std::optional<Instant> first_tick_;
  Instant polled_at_{};
  std::optional<Problem> missing_;
};

// When the car's first frame arrived.
Result<Instant, Problem> start_car(ProcessSupervisor& processes, CanSocket& bus, BenchIo& io,
                                   const std::string& interface) {
  if (auto problem = processes.start()) return Unexpected{*problem};
  const Instant limit = transport::monotonic_now() + kStartLimit;
  std::array<can::ReceivedFrame, CanSocket::kBatch> inbox{};
  while (transport::monotonic_now() < limit && !io.stopped()) {
    if (bus.receive(inbox) > 0) return inbox.front().at;
    io.wait_until(transport::monotonic_now() + kPollPeriod);
  }
  return Unexpected{io.missing().value_or(Problem{interface, "no frame of the car has arrived"})};
}

struct Playable {
  replay::Timeline timeline;
  Duration first{};  // of its first frame or bytes, since the first tick
};

bool is_played(const traffic::Source& source) {
  return source.name == recorder::kReceivedTopic ||
         std::ranges::find(kReceiverSources, source.name) != kReceiverSources.end();
}

std::optional<UtcTime> first_of(const traffic::Recording& recording,
                                bool (*wanted)(const traffic::Source&)) {
  const auto found = std::ranges::find_if(recording.records, [&](const traffic::Record& record) {
    return wanted(recording.sources[record.source]);
  });
  return found == recording.records.end() ? std::nullopt : std::optional{found->at};
}

replay::TimelineOptions options_of(const traffic::Recording& recording, const LivePlan& plan) {
  replay::TimelineOptions options{.interface = plan.interface};
  for (std::size_t unit = 0; unit < kReceiverSources.size(); ++unit) {
    const auto source =
        std::ranges::find(recording.sources, kReceiverSources[unit], &traffic::Source::name);
    if (source == recording.sources.end() || source->records == 0) continue;
    const auto port = static_cast<std::uint16_t>(plan.gnss_port + unit);
    options.receivers.emplace_back(source->name, UdpAddress{kLoopbackIp, port});
  }
  return options;
}

// The first run of the recording: what came after its last tick was for another one.
Result<Playable, Problem> playable(traffic::Recording recording, const CommandTrace& recorded,
                                   const LivePlan& plan) {
  const auto tick = first_of(
      recording, [](const traffic::Source& source) { return source.name == recorder::kTickTopic; });
  const auto first = first_of(recording, is_played);
  if (!tick || !first)
    return Unexpected{
        Problem{"recording", "holds no input of the car: neither frames nor bytes of receivers"}};
  const std::int64_t end_ns = tick->ns + recorded.length.ns;
  std::erase_if(recording.records,
                [&](const traffic::Record& record) { return record.at.ns > end_ns; });
  auto timeline = replay::make_timeline(recording, options_of(recording, plan));
  if (!timeline) return Unexpected{timeline.error()};
  return Playable{*std::move(timeline), Duration{first->ns - tick->ns}};
}

// The car is not armed where the recorded one was not.
std::array<Member, kRoles> members_for(const LivePlan& plan, const CommandTrace& recorded) {
  std::array<Member, kRoles> members = members_of(plan);
  Member& car = members[static_cast<std::size_t>(Role::kCar)];
  if (!recorded.armed_at_start) car.command = car.restart;
  return members;
}

}  // namespace

Result<PlayedRun, Problem> play_to_car(traffic::Recording recording, const CommandTrace& recorded,
                                       const LivePlan& plan) {
  const auto playing = playable(std::move(recording), recorded, plan);
  if (!playing) return Unexpected{playing.error()};
  auto time = BenchTime::of_run(plan.clock, plan.clock_line);
  if (!time) return Unexpected{time.error()};
  auto bus = CanSocket::open(plan.interface);
  if (!bus) return Unexpected{bus.error()};
  auto sockets = replay::SocketIo::open(playing->timeline);
  if (!sockets) return Unexpected{sockets.error()};
  auto base = open_base(recorded, plan);
  if (!base) return Unexpected{base.error()};
  transport::request_realtime(kPriority);
  ProcessSupervisor processes{members_for(plan, recorded), {}};
  BenchIo io{*sockets, processes, *std::move(base), *std::move(time)};
  io.begin();
  const auto received_at = start_car(processes, *bus, io, plan.interface);
  if (!received_at) return Unexpected{received_at.error()};
  { const CanSocket done = *std::move(bus); }  // nobody reads it any more
  const Instant first_tick = *received_at - recorded.first_frame.value_or(Duration{});
  io.start(first_tick);
  replay::Player player{playing->timeline, {}, io};
  PlayedRun played{.report = player.play(first_tick + playing->first), .waits = {}};
  io.wait_until(first_tick + recorded.length + kSettle);
  io.end();
  if (io.missing()) return Unexpected{*io.missing()};
  if (sockets->stopped())
    return Unexpected{Problem{"--live", "stopped by a signal before all was played"}};
  if (auto problem = processes.finish(ProcessSupervisor::kStopLimit, [] {
        transport::sleep_until(transport::monotonic_now() + kLookAtCar);
      }))
    return Unexpected{*problem};
  played.waits = io.waits();
  return played;
}

}  // namespace pitwall::bench
