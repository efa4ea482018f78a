// Plan of one car's session, checked from the command line before it begins.
//   in     command lines; the files that they name; `say`: lines for a person
//   out    a Plan for each car; the web server's part of them all
//   errors Problem with the option as place; two cars that have the same keys: what one of them
//          says would be taken for the other; or the same stamp file
//          a stamp file that cannot be read is told: the car is served without it
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

using Say = std::function<void(const std::string&)>;

struct Plan {
  settings::Arguments arguments;
  std::vector<transport::UdpAddress> listen{};
  inputs::CommandScript script{};
  telemetry::LinkEndpointConfig config{};
  std::string stamp_file{};            // empty: none
  publishers::web::HttpConfig http{};  // documents: those of this car
  service::ServiceConfig service{};
  publishers::console::ConsoleConfig console{};
  inputs::JoystickMapping joystick{};
};

Result<Plan, Problem> plan_of(const settings::Arguments& arguments, const Say& say);
Result<std::vector<Plan>, Problem> plans_of(std::span<const settings::Arguments> cars,
                                            const Say& say);
// Of a replay: no radio, no keys.
Result<Plan, Problem> plan_of_replay(const settings::Arguments& arguments, const Say& say);

// Of a file of tokens; without one nothing changes.
Result<bool, Problem> use_tokens(const std::string& file, publishers::web::AccessRules& access);
// Of --web-certificate and --web-key; without them none.
Result<std::shared_ptr<ssl_ctx_st>, Problem> tls_of(const settings::Arguments& arguments,
                                                    const Say& say);

// One server for all of them; each has its documents under its number.
publishers::web::HttpConfig served(std::span<Plan> plans);

}  // namespace pitwall::session
