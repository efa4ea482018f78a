// Requests of a console, parsed from JSON, as PROTOCOL.md describes them.
//   in     one JSON text of a client
//   out    the request with every number in its range; the role that it needs
//   errors Problem with the member as place; no value is guessed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "basestation/command/request.hpp"
#include "basestation/publishers/bench/bench_link.hpp"
#include "basestation/publishers/web/admission/client.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::publishers::console {

using web::ClientId;
using web::Role;

inline constexpr std::size_t kPointsMax = 20'000;

struct AskHistory {
  std::uint16_t field = 0;
  double from_s = 0.0, to_s = 0.0;  // seconds before now; from_s is the larger
  std::size_t points = kPointsMax;
};
struct AskLap {
  std::uint32_t lap = 0;
};
struct AskSend {
  std::uint32_t ticket = 0;
  bool overrides = false;
  std::string reason, token;  // of an override
};
struct AskMark {
  std::string text;
};
struct AskPing {
  double at = 0.0;
};
struct AskBench {
  bench::BenchRequest run_request;
};
// For a replay only.
struct AskPlayback {
  std::optional<double> speed;  // recorded seconds per second; 0: pause; negative: backwards
  std::optional<double> to_ms;  // on the clock of time_ns
};

using Request = std::variant<AskHistory, AskLap, AskPing, AskMark, AskSend, AskBench, AskPlayback,
                             command::Request>;

Result<Request, Problem> parse_request(std::string_view text);
Role role_for(const Request& request);

}  // namespace pitwall::publishers::console
