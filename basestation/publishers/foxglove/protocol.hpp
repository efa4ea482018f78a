// Messages of the Foxglove WebSocket protocol, version 1, encoded and decoded without a socket.
//   in     channels, times, states; texts and bytes of clients
//   out    JSON texts and binary messages, little endian; requests
//   invariants
//          read only: requests that would change anything are decoded and named, so that they can
//          be refused with a reason
//   units  times in ns since 1970
//   errors Problem with the place in the message: not JSON, unknown op, wrong type, truncated
//   source foxglove/ws-protocol docs/spec.md; foxglove/foxglove-sdk rust/foxglove/src/protocol:
//          PlaybackState, PlaybackControlRequest, ServerInfo
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::foxglove {

// Two names of the same subprotocol; a client offers one or both.
inline constexpr std::array<std::string_view, 2> kSubprotocols{"foxglove.sdk.v1",
                                                               "foxglove.websocket.v1"};

struct ChannelRow {
  std::uint32_t id = 0;
  std::string topic{}, encoding{}, schema_name{}, schema_encoding{}, schema{};
  bool latched = false;  // a new subscriber gets the newest message at once
};

// Parameter that clients may read and nobody can set here.
struct Parameter {
  std::string name;
  double value = 0.0;

  friend bool operator==(const Parameter&, const Parameter&) = default;
};

struct TimeRange {
  UtcTime begin{}, end{};
};

struct ServerInfo {
  std::string name, session;
  std::optional<TimeRange> playback{};  // of a recording with playback control
};

enum class Level : std::uint8_t { kInfo, kWarning, kError };
enum class PlaybackStatus : std::uint8_t { kPlaying, kPaused, kBuffering, kEnded };

struct PlaybackState {
  PlaybackStatus status = PlaybackStatus::kPaused;
  UtcTime at{};
  float speed = 1.0F;
  bool did_seek = false;
  std::string request{};  // that this answers; may be empty
};

std::string server_info_text(const ServerInfo& info);
std::string advertise_text(std::span<const ChannelRow> channels);
std::string status_text(Level level, std::string_view message);
// `request`: that this answers; empty for a change without a request.
std::string parameters_text(std::span<const Parameter> parameters, const std::string& request);
// Connection graph: `publisher` publishes all topics, and nothing is subscribed to.
std::string graph_text(std::span<const ChannelRow> channels, std::string_view publisher);

inline constexpr std::size_t kMessageHeader = 13;
std::array<std::uint8_t, kMessageHeader> message_header(std::uint32_t subscription, UtcTime at);
std::vector<std::uint8_t> time_bytes(UtcTime at);
std::vector<std::uint8_t> playback_bytes(const PlaybackState& state);

struct Subscription {
  std::uint32_t id = 0, channel = 0;
};
struct Subscribe {
  std::vector<Subscription> wanted;
};
struct Unsubscribe {
  std::vector<std::uint32_t> ids;
};
struct PlaybackControl {
  bool play = false;
  float speed = 1.0F;
  std::optional<UtcTime> seek{};
  std::string request;
};
struct GetParameters {
  std::vector<std::string> names;  // empty: all
  std::string request;
};
struct WatchParameters {
  std::vector<std::string> names;  // empty: all
  bool ends = false;
};
struct WatchGraph {
  bool ends = false;
};
// Request that this server does not support, with the capability that it would need.
struct Refusable {
  std::string_view capability;
};
using Request = std::variant<Subscribe, Unsubscribe, PlaybackControl, GetParameters,
                             WatchParameters, WatchGraph, Refusable>;

Result<Request, Problem> parse_text(std::string_view text);
Result<Request, Problem> parse_binary(std::span<const std::uint8_t> bytes);

}  // namespace pitwall::publishers::foxglove
