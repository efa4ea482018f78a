// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/message_publisher.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "basestation/service/car_service.hpp"
#include "basestation/service/messages/checklist_text.hpp"
#include "basestation/service/messages/lap_text.hpp"
#include "basestation/service/messages/message_text.hpp"
#include "basestation/service/messages/settings_text.hpp"

namespace pitwall::service {
namespace {

// What was entered, as the judge was told where it has not reckoned with it yet.
double fuel_left_l(const CarService& car, Instant now) {
  const double level_l = car.evaluator().fuel().level_l;
  const bool reckoned =
      now - car.requests().entries().fuel_at >= seconds(1) && !std::isnan(level_l);
  const state::Expectations& entered = car.evaluator().known().expected;
  return reckoned ? level_l : entered.fuel_loaded_l - entered.fuel_used_l;
}

}  // namespace

void MessagePublisher::publish(const CarService& car, MessageLog& to, Instant now) {
  publish_identity(car, to, now);
  publish_alarms(car, to, now);
  publish_stop(car, to, now);
  publish_commands(car, to, now);
  publish_events(car, to, now);
  publish_fuel(car, to, now);
  publish_settings(car, to, now);
  publish_checks(car, to, now);
  publish_laps(car, to, now);
  begun_ = true;
}

void MessagePublisher::publish_identity(const CarService& car, MessageLog& to, Instant now) {
  const Shown shown{.source = car.link().source(),
                    .revision = car.requests().settings().revision()};
  if (begun_ && shown == shown_) return;
  shown_ = shown;
  to.pass("hello", hello_text(car.identity(), now), now);
}

void MessagePublisher::publish_alarms(const CarService& car, MessageLog& to, Instant now) {
  const alarms::Engine& engine = car.evaluator().alarms();
  if (!begun_ || engine.revision() != alarms_) {
    alarms_ = engine.revision();
    to.set_state("alarms", alarms_text(engine), now);
  }
  if (engine.events() != alarm_events_) {
    for (const alarms::AlarmEvent& event : engine.history()) {
      if (event.number > alarm_events_) to.add_line("alarm_event", alarm_event_text(event), now);
    }
    alarm_events_ = engine.events();
  }
  const alarms::Notices& notices = car.evaluator().notices();
  if (notices.revision() == notice_revision_) return;
  notice_revision_ = notices.revision();
  for (const alarms::Notice& notice : notices.all()) {
    if (std::ranges::find(notices_, notice) != notices_.end()) continue;
    to.add_line("notice", notice_text(notice), now);
  }
  notices_.assign(notices.all().begin(), notices.all().end());
}

void MessagePublisher::publish_stop(const CarService& car, MessageLog& to, Instant now) {
  if (begun_ && now - stop_at_ < kStopEvery) return;
  stop_at_ = now;
  std::string text = stop_text(car.stopped());
  if (text == stop_) return;
  stop_ = std::move(text);
  to.set_state("stop_state", stop_, now);
}

void MessagePublisher::publish_commands(const CarService& car, MessageLog& to, Instant now) {
  const command::AuthorityHandover& authority = car.requests().authority();
  const bool renewed = authority.holder(now) != 0 && now - authority_at_ >= seconds(1);
  if (!begun_ || authority.revision() != authority_ || renewed) {
    authority_ = authority.revision();
    authority_at_ = now;
    to.set_state("authority", authority_text(authority, car.link().endpoint().authority(), now),
                 now);
  }
  publish_tickets(car.requests().queue(), to, now);
  const command::Audit& audit = car.requests().audit();
  if (audit.count() == audit_) return;
  for (const command::AuditLine& line : audit.lines()) {
    if (line.number > audit_) to.add_line("audit", audit_text(line), now);
  }
  audit_ = audit.count();
}

void MessagePublisher::publish_tickets(const command::CommandQueue& queue, MessageLog& to,
                                       Instant now) {
  if (queue.revision() == tickets_) return;
  std::vector<const command::Ticket*> changed;
  for (const command::Ticket& ticket : queue.tickets()) {
    if (ticket.revision > tickets_) changed.push_back(&ticket);
  }
  std::ranges::sort(changed, {}, &command::Ticket::revision);
  for (const command::Ticket* const ticket : changed) {
    to.add_line("command", ticket_text(*ticket), now);
  }
  tickets_ = queue.revision();
}

void MessagePublisher::publish_fuel(const CarService& car, MessageLog& to, Instant now) {
  if (begun_ && now - fuel_at_ < kFuelEvery) return;
  fuel_at_ = now;
  std::string fuel = fuel_text(car.evaluator().fuel());
  if (fuel == fuel_) return;
  fuel_ = fuel;
  to.set_state("fuel", std::move(fuel), now);
}

void MessagePublisher::publish_events(const CarService& car, MessageLog& to, Instant now) {
  const auto& events = car.link().events();
  const std::uint64_t received = car.link().events_received();
  const std::uint64_t fresh = std::min<std::uint64_t>(received - events_, events.size());
  for (std::size_t i = events.size() - fresh; i < events.size(); ++i) {
    to.add_line("event", event_text(events[i]), now);
  }
  events_ = received;
}

void MessagePublisher::publish_settings(const CarService& car, MessageLog& to, Instant now) {
  const command::OperatorEntries& entries = car.requests().entries();
  const bool again = entries.revision != 0 && now - entries_at_ >= kEntriesEvery;
  if (!begun_ || entries.revision != entries_ || again) {
    entries_ = entries.revision;
    entries_at_ = now;
    to.set_state("expected", expected_text(entries, fuel_left_l(car, now), now), now);
  }
  const command::SettingsEditor& settings = car.requests().settings();
  if (begun_ && settings.revision() == settings_) return;
  settings_ = settings.revision();
  to.set_state("settings",
               settings_text(settings, car.evaluator().alarms().settings(), car.settings_problem()),
               now);
}

void MessagePublisher::publish_checks(const CarService& car, MessageLog& to, Instant now) {
  if (begun_ && now - checks_at_ < kChecksEvery) return;
  checks_at_ = now;
  to.set_state("checklist", checklist_text(car.checks(now), now), now);
}

void MessagePublisher::publish_laps(const CarService& car, MessageLog& to, Instant now) {
  const state::LapLog* const laps = car.laps();
  if (laps == nullptr || laps->revision() == laps_) return;
  laps_ = laps->revision();
  to.set_state("laps", laps_text(*laps), now);
}

void MessagePublisher::publish_link(const CarService& car, MessageLog& to, Instant now) {
  const state::LinkState state = car.evaluator().link_state();
  if (state == link_ && now - link_at_ < kLinkEvery) return;
  link_ = state;
  link_at_ = now;
  to.set_state("link",
               link_text({.report = car.link().report(now),
                          .meter = car.link_meter(),
                          .vehicle = car.vehicle(),
                          .state = state,
                          .since = car.evaluator().link_since(),
                          .paths = car.link().paths(),
                          .up_cap_kbit_s = car.requests().settings().budget().now},
                         now),
               now);
}

}  // namespace pitwall::service
