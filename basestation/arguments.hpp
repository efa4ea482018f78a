// The command line of pitwall-base.
//   out    Arguments, or what to print and the exit code: 0 after --help, 2 after a mistake
//   rule   loopback unless --network is given as well
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::basestation {

inline constexpr std::uint16_t kDefaultPort = 23'431;

struct Arguments {
  transport::UdpAddress listen{.port = kDefaultPort};
  bool text = false, plain = false;
  Duration duration{};  // zero: until stopped
  double refresh_hz = 10.0;
  std::string json_path;  // empty: no summary
};

struct Refusal {
  int exit_code = 2;
  std::string text;
};

Result<Arguments, Refusal> parse_arguments(int argc, const char* const* argv);

}  // namespace pitwall::basestation
