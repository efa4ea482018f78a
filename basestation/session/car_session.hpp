// Session of one car at the base: its service with its resources of the machine (sockets, files,
// devices) and its publishers, built from a Plan. Several sessions share the loop and the web
// server, and nothing else.
//   in     a Plan; the web server, if there are consoles
//   out    what the event loop serves
//   invariants  sockets are open before anything is logged or written; a member outlives its users
//   errors open(), begin(): Problem with the socket, folder or device
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basestation/inputs/command_socket.hpp"
#include "basestation/publishers/console/console_service.hpp"
#include "basestation/publishers/web/web_server.hpp"
#include "basestation/service/event_loop.hpp"
#include "basestation/session/plan.hpp"
#include "basestation/session/roster.hpp"
#include "protocol/recorder/recorder.hpp"
#include "protocol/telemetry/session/crypto/randomness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::session {

class CarSession {
 public:
  // With open sockets, and a service that has received nothing.
  static Result<std::unique_ptr<CarSession>, Problem> open(Plan plan);
  std::string title() const;  // "CAR 7 Blue"
  // "listening at ADDRESS and ADDRESS"
  std::string listening() const;

  // Starts consoles (if there is a server), recording, joystick.
  Result<bool, Problem> begin(publishers::web::WebServer* server, const LogLine& log);
  // Adds a publisher, which is served after those that are there already.
  void attach(std::unique_ptr<service::Publisher> publisher);

  service::CarLoop loop();
  // Writes the summary of the run, if the arguments name a file for it.
  Result<bool, Problem> write_summary();

  CarStatus status() const;
  const settings::Arguments& arguments() const { return plan_.arguments; }
  service::CarService& service() { return *service_; }

 private:
  explicit CarSession(Plan plan) : plan_(std::move(plan)) {}
  Result<bool, Problem> open_sockets();
  Result<bool, Problem> begin_recording(const LogLine& log);
  Result<bool, Problem> begin_joystick();
  void begin_consoles(publishers::web::WebServer& server);

  Plan plan_;
  telemetry::SystemRandomness randomness_;
  std::vector<transport::UdpSocket> radio_;
  std::optional<transport::UdpSocket> stop_port_;
  std::optional<inputs::CommandSocket> commands_;
  std::unique_ptr<recorder::Recorder> recording_;  // outlives all that write to it
  std::unique_ptr<service::CarService> service_;
  std::vector<std::unique_ptr<service::Publisher>> owned_;
  std::vector<service::Publisher*> publishers_;
};

}  // namespace pitwall::session
