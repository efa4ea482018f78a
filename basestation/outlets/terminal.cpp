// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/terminal.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/outlets/log_text.hpp"
#include "basestation/outlets/text_view.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::outlets {
namespace {

constexpr int kMaxRounds = 64;  // a flood must not keep screen and stop signal waiting
constexpr std::size_t kMaxLines = transport::kMaxWatched;

// One car's part of each turn.
class Line {
 public:
  explicit Line(const Lines& lines) : lines_(lines), station_(*lines.station) {}

  template <class Watched>
  void watch(Watched& watched) const {
    for (const transport::UdpSocket& socket : lines_.radio) CHECK(watched.push(socket.fd()));
    if (lines_.words != nullptr) CHECK(watched.push(lines_.words->fd()));
    for (const Outlet* const outlet : lines_.outlets) {
      if (outlet->fd() >= 0) CHECK(watched.push(outlet->fd()));
    }
  }

  Instant due() const {
    Instant due = std::min(station_.due(), script_due());
    for (const Outlet* const outlet : lines_.outlets) due = std::min(due, outlet->due());
    return due;
  }

  void listen(std::span<transport::UdpDatagram> batch) {
    drain(batch);
    hear_words(batch);
  }

  void serve(Instant now) {
    say_script(now);
    for (Outlet* const outlet : lines_.outlets) outlet->serve(station_, now);
    send(now);
  }

  // For the log of a base without a screen.
  void tell_threats() {
    const auto& events = station_.events();
    const std::uint64_t fresh =
        std::min<std::uint64_t>(station_.events_heard() - events_told_, events.size());
    events_told_ = station_.events_heard();
    for (std::size_t i = events.size() - fresh; i < events.size(); ++i) {
      if (events[i].kind != telemetry::EventKind::kThreat) continue;
      std::fprintf(stderr, "pitwall-base: %s: %s\n", lines_.title.c_str(),
                   event_text(events[i]).c_str());
    }
  }

  std::string screen(Instant now, const ViewOptions& options) {
    station_.advance(now);
    return text_view(station_, now, options);
  }
  const std::string& title() const { return lines_.title; }

 private:
  // Each datagram is taken and answered before the next: a reply is kept until then only.
  void drain(std::span<transport::UdpDatagram> batch) {
    for (std::size_t path = 0; path < lines_.radio.size(); ++path) {
      for (int round = 0; round < kMaxRounds; ++round) {
        const std::size_t n = lines_.radio[path].receive(batch);
        for (std::size_t i = 0; i < n; ++i) take(batch[i], static_cast<telemetry::PathId>(path));
        if (n < batch.size()) break;
      }
    }
  }

  void take(const transport::UdpDatagram& datagram, telemetry::PathId path) {
    const telemetry::Address from{.ip = datagram.from.ip, .port = datagram.from.port};
    if (station_.take(datagram.payload(), path, from, datagram.at)) {
      for (Outlet* const outlet : lines_.outlets) outlet->packet(station_, *station_.arrival());
    }
    if (station_.due() <= datagram.at) send(transport::monotonic_now());
  }

  void send(Instant now) {
    while (const auto out = station_.poll(now)) {
      const transport::UdpAddress to{.ip = out->to.ip, .port = out->to.port};
      lines_.radio[out->path].send_to(to, out->bytes);
    }
  }

  void hear_words(std::span<transport::UdpDatagram> batch) {
    if (lines_.words == nullptr) return;
    const std::size_t n = lines_.words->receive(batch);
    for (std::size_t i = 0; i < n; ++i) {
      const auto bytes = batch[i].payload();
      say({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, batch[i].at);
    }
  }

  Instant script_due() const {
    if (lines_.script == nullptr || !station_.rate().ever()) return Instant::max();
    const auto due = lines_.script->due();
    return due ? station_.rate().first() + *due : Instant::max();
  }

  void say_script(Instant now) {
    if (lines_.script == nullptr || !station_.rate().ever()) return;
    while (const auto words = lines_.script->next(now - station_.rate().first())) say(*words, now);
  }

  void say(std::string_view words, Instant now) {
    const auto obeyed = station_.obey(words, now);
    if (!obeyed) std::fprintf(stderr, "pitwall-base: %s\n", to_string(obeyed.error()).c_str());
  }

  Lines lines_;
  intake::Station& station_;
  std::uint64_t events_told_ = 0;
};

class Loop {
 public:
  Loop(std::span<const Lines> cars, const TerminalOptions& options, int stop, std::FILE* terminal)
      : cars_(cars.begin(), cars.end()), options_(options), terminal_(terminal) {
    CHECK(watched_.push(stop));
    for (const Line& car : cars_) car.watch(watched_);
  }

  void run() {
    const Instant start = transport::monotonic_now();
    const Instant end = options_.duration.ns > 0 ? start + options_.duration : Instant::max();
    next_screen_ = options_.text ? start : Instant::max();
    bool stopped = false;
    while (!stopped) {
      Instant due = std::min(next_screen_, end);
      for (const Line& car : cars_) due = std::min(due, car.due());
      const std::uint32_t ready = transport::wait_readable(watched_.span(), due, longest_wait_);
      for (Line& car : cars_) car.listen(batch_);
      const Instant now = transport::monotonic_now();
      for (Line& car : cars_) car.serve(now);
      show_if_due(now);
      if (!options_.text) tell_threats();
      stopped = (ready & 1U) != 0 || now >= end;
    }
    if (options_.text) show(transport::monotonic_now());
  }

 private:
  void show_if_due(Instant now) {
    if (now < next_screen_ && !is_pause_to_be_shown()) return;
    show(now);
    next_screen_ = now + options_.refresh;
  }

  // While bench time stands no screen comes due by itself.
  bool is_pause_to_be_shown() const {
    const auto pause = transport::bench_pause();
    return options_.text && pause && pause->now >= shown_pause_ + options_.refresh;
  }

  void tell_threats() {
    for (Line& car : cars_) car.tell_threats();
  }

  void show(Instant now) {
    const auto pause = transport::bench_pause();
    shown_pause_ = pause ? pause->now : Duration{};
    std::string screen;
    for (Line& car : cars_) {
      screen += car.screen(now, {.ansi = !options_.plain,
                                 .all = options_.all,
                                 .below = !screen.empty(),
                                 .title = cars_.size() > 1 ? car.title() : std::string{},
                                 .pause = pause});
    }
    std::fwrite(screen.data(), 1, screen.size(), terminal_);
    std::fflush(terminal_);
  }

  std::vector<Line> cars_;
  TerminalOptions options_;
  std::FILE* terminal_;
  FixedVector<int, kMaxLines> watched_;
  std::vector<transport::UdpDatagram> batch_ =
      std::vector<transport::UdpDatagram>(transport::UdpSocket::kBatch);
  // No console and no screen waits for a base that goes by the wall clock.
  Duration longest_wait_ = transport::bench_pause() ? kLookEvery : transport::kHoweverLong;
  Instant next_screen_ = Instant::max();
  Duration shown_pause_{};  // how long bench time had stood on the newest screen
};

}  // namespace

void run_terminal(std::span<const Lines> cars, const TerminalOptions& options, int stop,
                  std::FILE* terminal) {
  Loop(cars, options, stop, terminal).run();
}

}  // namespace pitwall::outlets
