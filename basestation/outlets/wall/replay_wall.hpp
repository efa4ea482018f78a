// The pit wall of a recording: consoles see it as they saw the race. There is no station and no
// endpoint in it: nothing that a console says can leave it.
//   in     a Player; what consoles say; how much time has passed
//   out    messages to the server; the recorded texts as they were; the same to tools that attach
//   law    every console sees the same moment; whoever may look may play, pause and jump
//          ages, judgements and derived values are computed as of the recording's time
//   errors commands, stops, authority and alarms are refused with a reason
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "basestation/outlets/wall/console_room.hpp"
#include "basestation/outlets/wall/wall.hpp"
#include "basestation/outlets/web/web_server.hpp"
#include "basestation/picture/trends.hpp"
#include "basestation/picture/watch/watch.hpp"
#include "basestation/replay/player.hpp"

namespace pitwall::outlets::wall {

class ReplayWall : private Eyes, private replay::Listener {
 public:
  ReplayWall(WallConfig config, replay::Player player, web::WebServer& server);

  void serve(Duration passed);
  // Who is told what the consoles are told; who winds for a tool.
  void tell_also(replay::Listener& listener) { others_.push_back(&listener); }
  void wind(double speed, std::optional<Instant> to);
  const replay::Player& player() const { return player_; }

 private:
  static constexpr Duration kTellEvery = milliseconds(500);

  picture::FieldView view(picture::FieldId field, Instant now) const override;
  picture::Judgement judge(picture::FieldId field, const picture::FieldView& v) const override;
  std::vector<picture::TrendPoint> past(picture::FieldId field, Instant from, Instant to,
                                        std::size_t points) const override;
  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
             Instant received) override;
  void text(recorder::Topic topic, Instant at, std::string_view json) override;
  void restart(Instant to) override;

  void settle(std::string_view json);
  void tell_judge(Instant at, std::string_view json);
  void hear();
  void obey(web::ClientId client, const Request& request);
  void tell(Duration passed);
  std::string playback_text() const;

  WallConfig config_;
  replay::Player player_;
  web::WebServer& server_;
  picture::Picture picture_;
  std::optional<picture::Trends> trends_;
  std::optional<picture::Watch> watch_;
  ConsoleRoom room_;
  bool unsettled_ = true;  // since the jump nothing was judged
  std::optional<Instant> heard_;
  std::uint64_t jumps_ = 0;
  Duration untold_ = kTellEvery;  // since the playback was told
  std::vector<replay::Listener*> others_;
};

// Serves it until the descriptor is readable or, where it is not zero, the duration is over. `also`
// is done in every turn.
void run_replay(ReplayWall& wall, int server, int stop, Duration duration,
                const std::function<void(Instant now)>& also = {});

}  // namespace pitwall::outlets::wall
