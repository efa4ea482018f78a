// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/text/terminal.hpp"

#include <algorithm>

#include "basestation/publishers/text/text_view.hpp"
#include "basestation/state/event_text.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::publishers {

void Screen::serve(Instant now) {
  if (now < next_ && !is_pause_to_be_shown()) return;
  show(now);
  next_ = now + options_.refresh;
}

// While bench time stands no screen comes due by itself.
bool Screen::is_pause_to_be_shown() const {
  const auto pause = transport::bench_pause();
  return pause && pause->now >= shown_pause_ + options_.refresh;
}

void Screen::show(Instant now) {
  const auto pause = transport::bench_pause();
  shown_pause_ = pause ? pause->now : Duration{};
  std::string screen;
  for (TerminalCar& car : cars_) {
    screen += text_view(*car.service, now,
                        {.ansi = !options_.plain,
                         .all = options_.all,
                         .below = !screen.empty(),
                         .title = cars_.size() > 1 ? car.title : std::string{},
                         .pause = pause});
  }
  std::fwrite(screen.data(), 1, screen.size(), terminal_);
  std::fflush(terminal_);
}

void StationLog::serve(Instant /*now*/) {
  for (std::size_t car = 0; car < cars_.size(); ++car) {
    const service::CarService& service = *cars_[car].service;
    log_threats(service.link(), cars_[car].title, logged_[car]);
    log_refusals(service.requests().audit(), cars_[car].title, logged_[car]);
  }
}

void StationLog::log_threats(const link::Station& station, const std::string& title,
                             Logged& logged) {
  const auto& events = station.events();
  const std::uint64_t fresh =
      std::min<std::uint64_t>(station.events_received() - logged.events, events.size());
  logged.events = station.events_received();
  for (std::size_t i = events.size() - fresh; i < events.size(); ++i) {
    if (events[i].kind != telemetry::EventKind::kThreat) continue;
    std::fprintf(terminal_, "pitwall-base: %s: %s\n", title.c_str(),
                 state::event_text(events[i]).c_str());
  }
}

void StationLog::log_refusals(const command::Audit& audit, const std::string& title,
                              Logged& logged) {
  for (const command::AuditLine& line : audit.lines()) {
    if (line.number <= logged.audit || !line.result.starts_with("refused")) continue;
    std::fprintf(terminal_, "pitwall-base: %s: %s: %s: %s\n", title.c_str(), line.who.c_str(),
                 line.what.c_str(), line.result.c_str());
  }
  logged.audit = audit.count();
}

}  // namespace pitwall::publishers
