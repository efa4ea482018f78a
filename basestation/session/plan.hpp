// Plan of one car's session, checked from the command line before the session begins.
//   in     command lines; the files that they name; `log`: writes a line for the log
//   out    a Plan for each car; the configuration of their common web server
//   errors Problem with the option as place; also for two cars with the same keys, whose packets
//          could not be told apart, or with the same stamp file
//          a stamp file that cannot be read is only logged: the car is served without it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "basestation/inputs/command_script.hpp"
#include "basestation/inputs/joystick_reports.hpp"
#include "basestation/publishers/console/console_service.hpp"
#include "basestation/publishers/web/http_responder.hpp"
#include "basestation/settings/arguments.hpp"
#include "protocol/telemetry/endpoint/link_endpoint.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::session {

using LogLine = std::function<void(const std::string&)>;

struct Plan {
  settings::Arguments arguments;
  std::vector<UdpAddress> listen{};
  inputs::CommandScript script{};
  telemetry::LinkEndpointConfig config{};
  std::string stamp_file{};            // empty: no file
  publishers::web::HttpConfig http{};  // documents: of this car
  service::ServiceConfig service{};
  publishers::console::ConsoleConfig console{};
  inputs::JoystickMapping joystick{};
};

Result<Plan, Problem> plan_of(const settings::Arguments& arguments, const LogLine& log);
Result<std::vector<Plan>, Problem> plans_of(std::span<const settings::Arguments> cars,
                                            const LogLine& log);
// Plan of a replay: no radio, no keys.
Result<Plan, Problem> plan_of_replay(const settings::Arguments& arguments, const LogLine& log);

// Reads the file of tokens; an empty name changes nothing.
Result<bool, Problem> use_tokens(const std::string& file, publishers::web::AccessRules& access);
// TLS from --web-certificate and --web-key; nullptr without them.
Result<std::shared_ptr<ssl_ctx_st>, Problem> tls_of(const settings::Arguments& arguments,
                                                    const LogLine& log);

// Configuration of one web server for all cars; each has its documents under its number.
publishers::web::HttpConfig served(std::span<Plan> plans);

}  // namespace pitwall::session
