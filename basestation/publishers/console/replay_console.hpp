// Console service of a replay: consoles show the recording as they showed the race. It has no radio
// link, so that nothing from a console can reach a car.
//   in     a Player; texts of consoles; the time that has passed
//   out    messages to the server; the recorded texts as they were; the same to attached tools
//   invariants
//          every console shows the same moment; every client, also a viewer, may play, pause and
//          jump
//          history and laps are those of the whole recording, whatever was played of it
//          ages, judgements and derived values are computed as of the recording's time
//   errors commands, stops, authority and alarms are refused with a reason
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "basestation/alarms/evaluator.hpp"
#include "basestation/publishers/console/client_registry.hpp"
#include "basestation/publishers/web/web_server.hpp"
#include "basestation/replay/player.hpp"
#include "basestation/service/recorded/recording_index.hpp"

namespace pitwall::publishers::console {

class ReplayConsole : private StateSource, private replay::Listener {
 public:
  // `index`: of the recording that the player plays.
  ReplayConsole(service::ServiceConfig config, replay::Player player, service::RecordingIndex index,
                web::WebServer& server);

  void serve(Duration passed);
  // Adds a listener for all that the consoles get. control_playback(): playback control by a tool.
  void tell_also(replay::Listener& listener) { others_.push_back(&listener); }
  void control_playback(double speed, std::optional<Instant> to);
  const replay::Player& player() const { return player_; }

 private:
  static constexpr Duration kPublishPeriod = milliseconds(500);

  state::FieldView view(state::FieldId field, Instant now) const override;
  alarms::Evaluation evaluate(state::FieldId field, const state::FieldView& v) const override;
  std::vector<state::TrendPoint> past(state::FieldId field, Instant from, Instant to,
                                      std::size_t points) const override;
  const state::LapLog* laps() const override { return index_.laps(); }
  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
             Instant received) override;
  void text(recorder::Topic topic, Instant at, std::string_view json) override;
  void restart(Instant to) override;

  void settle(std::string_view json);
  void apply_judge_input(Instant at, std::string_view json);
  void receive();
  void execute(web::ClientId client, const Request& request);
  void publish(Duration passed);
  std::string playback_text() const;

  service::ServiceConfig config_;
  replay::Player player_;
  service::RecordingIndex index_;
  web::WebServer& server_;
  state::VehicleState vehicle_;
  std::optional<alarms::Evaluator> evaluator_;
  service::MessageLog messages_;
  ClientRegistry clients_;
  bool settings_pending_ = true;  // no state has been received since the jump
  std::optional<Instant> received_;
  std::uint64_t jumps_ = 0;
  Duration unreported_ = kPublishPeriod;  // since the last playback message
  std::vector<replay::Listener*> others_;
};

// Serves the console until `stop` is readable or, if it is not zero, the duration is over. `also`
// is called in every turn.
void run_replay(ReplayConsole& console, int server, int stop, Duration duration,
                const std::function<void(Instant now)>& also = {});

}  // namespace pitwall::publishers::console
