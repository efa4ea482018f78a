// One car's stand at the pit wall: its radio, its station, its consoles' view, its recording, its
// joystick. Several stands share the loop and the web server, and nothing else.
//   in     a Plan; the web server, where there are consoles
//   out    what the loop serves
//   law    sockets are open before anything is told or written; whoever tells another outlives it
//   errors open(), begin(): Problem with the socket, folder or device
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basestation/intake/station.hpp"
#include "basestation/outlets/joystick_feed.hpp"
#include "basestation/outlets/outlet.hpp"
#include "basestation/outlets/recorder/journal.hpp"
#include "basestation/outlets/terminal.hpp"
#include "basestation/outlets/wall/wall.hpp"
#include "basestation/outlets/web/web_server.hpp"
#include "basestation/stand/plan.hpp"
#include "basestation/stand/roster.hpp"
#include "protocol/recorder/recorder.hpp"
#include "protocol/telemetry/session/randomness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::stand {

class CarStand {
 public:
  // With its sockets, and a station that has heard nothing.
  static Result<std::unique_ptr<CarStand>, Problem> open(Plan plan);
  std::string title() const;  // "CAR 7 Blue"
  // "listening at ADDRESS and ADDRESS"
  std::string listening() const;

  // Consoles, where there is a server for them, recording, joystick.
  Result<bool, Problem> begin(outlets::web::WebServer* server, const Say& say);
  // Something else that shows or keeps what this car says; served after all that is there already.
  void attach(std::unique_ptr<outlets::Outlet> outlet);

  outlets::Lines lines();
  // Where it was asked for: what was heard and said.
  Result<bool, Problem> write_summary();

  CarSight sight() const;
  const settings::Arguments& arguments() const { return plan_.arguments; }
  intake::Station& station() { return *station_; }
  outlets::wall::Wall* wall() { return wall_.get(); }  // nullptr: no consoles

 private:
  explicit CarStand(Plan plan) : plan_(std::move(plan)) {}
  Result<bool, Problem> open_sockets();
  Result<bool, Problem> begin_recording(const Say& say);
  Result<bool, Problem> begin_joystick();
  command::JoystickState joystick_state(Instant now) const;

  Plan plan_;
  telemetry::SystemRandomness randomness_;
  std::vector<transport::UdpSocket> radio_;
  std::vector<transport::UdpSocket> words_;  // none or one
  std::unique_ptr<intake::Station> station_;
  std::unique_ptr<recorder::Recorder> recording_;  // outlives who tells it
  std::optional<recorder::Journal> journal_;
  std::optional<outlets::JoystickFeed> joystick_;
  std::unique_ptr<outlets::wall::Wall> wall_;
  std::vector<std::unique_ptr<outlets::Outlet>> attached_;
  std::vector<outlets::Outlet*> outlets_;
};

}  // namespace pitwall::stand
