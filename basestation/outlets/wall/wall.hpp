// The pit wall: what consoles see and do, between the station and the web server.
//   in     packets and figures of the station; what consoles say, by the server
//   out    messages to the server; stops, authority and commands to the station's endpoint
//   law    ages, qualities, judgements, alarms and gates are the base's: consoles show them
//          another state of the link is told in the turn of the loop in which it is found
//          a stop is said to the endpoint in the turn of the loop in which it was heard, before
//          anything is told to anybody
//   cost   serve(): some tens of microseconds, a frame with all fields about 50
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basestation/command/audit.hpp"
#include "basestation/command/authority_talk.hpp"
#include "basestation/command/checklist.hpp"
#include "basestation/command/desk.hpp"
#include "basestation/command/settings_desk.hpp"
#include "basestation/intake/station.hpp"
#include "basestation/outlets/outlet.hpp"
#include "basestation/outlets/wall/console_room.hpp"
#include "basestation/outlets/wall/errands.hpp"
#include "basestation/outlets/wall/judgement_store.hpp"
#include "basestation/outlets/wall/link_meter.hpp"
#include "basestation/outlets/wall/pause_report.hpp"
#include "basestation/outlets/wall/recall.hpp"
#include "basestation/outlets/web/access.hpp"
#include "basestation/outlets/web/web_server.hpp"
#include "basestation/picture/trends.hpp"
#include "basestation/picture/watch/watch.hpp"

namespace pitwall::outlets::wall {

struct WallConfig {
  int car = 0;
  std::string name;
  std::size_t place = 0;          // among the cars of the server
  double up_cap_kbit_s = kUnset;  // of each path
  double up_kbit_s = kUnset;      // as operators have lowered it; unset: the cap
  std::uint64_t revision = 0;     // of the settings
  // nullptr: changes are not kept
  std::shared_ptr<JudgementStore> store{};
  picture::WatchConfig watch{};
  command::GateParams gates{};
  web::Tokens tokens{};  // of the second person of an override
};

// The settings of the file, and where changes go. The course is not in it and comes afterwards.
void use_judgement(WallConfig& config, std::shared_ptr<JudgementStore> store, double up_cap_kbit_s);

// As consoles are told it.
const char* mode_of(intake::Station::Source source);

class Wall : public Outlet, private Eyes {
 public:
  Wall(WallConfig config, intake::Station& station, web::WebServer& server);

  void packet(const intake::Station& station, const telemetry::Arrival& arrival) override;
  void serve(intake::Station& station, Instant now) override;
  Instant due() const override;
  int fd() const override { return server_.fd(config_.place); }

  // What was known before this process began: picture, trends and logs, no alarms.
  void remember(const telemetry::Snapshot& state, telemetry::GroupSet groups);
  // What people had entered then, in force again; judged from `now` on.
  void recall(const Recalled& recalled, Instant now);

  // Who fills in how the recorder is; asked ten times a second.
  void watch_recorder(std::function<void(picture::BaseFigures&, Instant)> fill) {
    recorder_figures_ = std::move(fill);
  }
  // What the joystick does; asked for ten times a second.
  void watch_joystick(std::function<command::JoystickState(Instant)> state) {
    joystick_ = std::move(state);
  }

  // Whose scenarios and runs consoles see, and start; it lives as long as the wall.
  void attach(bench::BenchLink& bench);

  ConsoleRoom& room() { return room_; }
  picture::Watch& watch() { return watch_; }
  const picture::Watch& watch() const { return watch_; }
  // A field of the car or of the base, as consoles see it.
  picture::FieldView seen(picture::FieldId field, Instant now) const { return view(field, now); }
  const picture::Trends& trends() const { return trends_; }
  std::size_t history_bytes() const { return trends_.filled_bytes() + own_trends_.filled_bytes(); }

 private:
  static constexpr Duration kTellChecksEvery = seconds(1);
  static constexpr Duration kLinkEvery = milliseconds(100), kTellLinkEvery = milliseconds(500),
                            kTellSaidEvery = seconds(60);

  picture::FieldView view(picture::FieldId field, Instant now) const override;
  picture::Judgement judge(picture::FieldId field, const picture::FieldView& v) const override;
  std::vector<picture::TrendPoint> past(picture::FieldId field, Instant from, Instant to,
                                        std::size_t points) const override;

  void hear(intake::Station& station, Instant now);
  void do_now(intake::Station& station, web::ClientId client, const Request& request, Instant now);
  void measure(intake::Station& station, Instant now);
  void tell(intake::Station& station, Instant now);
  void tell_alarms(Instant now);
  void tell_desk(intake::Station& station, Instant now);
  void tell_events(intake::Station& station, Instant now);
  void tell_settings(Instant now);
  void tell_checks(Instant now);
  double fuel_left_l(Instant now) const;
  std::string catalogue() const;
  std::string settings_version() const;
  std::optional<Problem> settings_problem() const;
  picture::BaseFigures own_figures(const intake::Station& station,
                                   const telemetry::LinkReport& report, Instant now) const;
  void relay_flag(const intake::Station& station);
  void set_budget(intake::Station& station);

  WallConfig config_;
  web::WebServer& server_;
  picture::Picture picture_;
  picture::Trends trends_;
  picture::TrendTable own_trends_{picture::kBaseFields};
  picture::Watch watch_;
  LinkMeter meter_;
  PauseReport pauses_;
  command::Audit audit_;
  command::AuthorityTalk talk_;
  command::Desk desk_;
  command::SettingsDesk settings_;
  PeopleSaid said_;
  std::function<command::JoystickState(Instant)> joystick_;
  std::function<void(picture::BaseFigures&, Instant)> recorder_figures_;
  bench::BenchLink* bench_ = nullptr;
  double budget_set_ = kUnset;
  ConsoleRoom room_;
  Instant measured_{}, told_link_{}, told_checks_{};
  picture::LinkState link_told_ = picture::LinkState::kNone;
  // What consoles have been told of.
  std::uint64_t alarms_told_ = 0, alarm_events_told_ = 0, notices_told_ = 0;
  std::uint64_t audit_told_ = 0, authority_told_ = 0, events_told_ = 0;
  std::uint64_t said_told_ = 0, settings_told_ = 0;
  bool states_told_ = false;
  Instant authority_said_{}, said_at_{};
  std::string fuel_told_;
  std::vector<alarms::Notice> notices_said_;
};

}  // namespace pitwall::outlets::wall
