// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/protocol.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "protocol/json/json_text.hpp"
#include "protocol/json/json_value.hpp"

namespace pitwall::publishers::foxglove {
namespace {

using json::JsonValue;

constexpr unsigned kBitsPerByte = 8;
constexpr std::size_t kNamed = 40;  // characters of what a client said, told back to it
enum class ServerOp : std::uint8_t { kMessageData = 1, kTime = 2, kPlaybackState = 5 };
enum class ClientOp : std::uint8_t { kMessageData = 1, kServiceCall = 2, kPlaybackControl = 3 };

template <class Number>
void put(std::uint8_t* at, Number number) {
  const auto bits = static_cast<std::uint64_t>(number);
  for (std::size_t i = 0; i < sizeof number; ++i) {
    at[i] = static_cast<std::uint8_t>(bits >> (kBitsPerByte * i));
  }
}
template <class Number>
void append(std::vector<std::uint8_t>& out, Number number) {
  out.resize(out.size() + sizeof number);
  put(out.data() + out.size() - sizeof number, number);
}

// Takes numbers from the front; what is too short gives zeros and is not ok().
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class Number>
  Number take() {
    ok_ = ok_ && bytes_.size() >= sizeof(Number);
    if (!ok_) return 0;
    std::uint64_t bits = 0;
    for (std::size_t i = sizeof(Number); i-- > 0;) bits = bits << kBitsPerByte | bytes_[i];
    bytes_ = bytes_.subspan(sizeof(Number));
    return static_cast<Number>(bits);
  }
  std::string rest(std::size_t length) {
    ok_ = ok_ && bytes_.size() == length;
    return ok_ ? std::string{bytes_.begin(), bytes_.end()} : std::string{};
  }
  bool ok() const { return ok_; }

 private:
  std::span<const std::uint8_t> bytes_;
  bool ok_ = true;
};

std::string time_json(UtcTime at) {
  return json::Object{}
      .number("sec", at.ns / kNanosecondsPerSecond)
      .number("nsec", at.ns % kNanosecondsPerSecond)
      .str();
}

std::optional<std::uint32_t> id_of(double number) {
  if (!(number >= 0.0 && number <= std::numeric_limits<std::uint32_t>::max())) return std::nullopt;
  return std::floor(number) == number ? std::optional{static_cast<std::uint32_t>(number)}
                                      : std::nullopt;
}

Result<Request, Problem> subscribe_of(const JsonValue& value) {
  Subscribe ask;
  for (const JsonValue& item : value.items("subscriptions")) {
    const auto id = id_of(item.number("id")), channel = id_of(item.number("channelId"));
    if (!id || !channel) {
      return Unexpected{Problem{"subscribe", "each subscription has a number id and channelId"}};
    }
    ask.wanted.push_back({*id, *channel});
  }
  return Request{ask};
}

Result<Request, Problem> unsubscribe_of(const JsonValue& value) {
  Unsubscribe ask;
  for (const JsonValue& item : value.items("subscriptionIds")) {
    const auto id = id_of(item.number());
    if (!id) return Unexpected{Problem{"unsubscribe", "subscriptionIds are numbers"}};
    ask.ids.push_back(*id);
  }
  return Request{ask};
}

std::vector<std::string> names_of(const JsonValue& value) {
  std::vector<std::string> names;
  for (const JsonValue& item : value.items("parameterNames")) names.push_back(item.text());
  return names;
}

struct RefusableOp {
  std::string_view op, capability;
};
constexpr std::array kRefusable{
    RefusableOp{"advertise", "clientPublish"}, RefusableOp{"unadvertise", "clientPublish"},
    RefusableOp{"setParameters", "setParameters"}, RefusableOp{"fetchAsset", "assets"}};

Result<Request, Problem> playback_of(std::span<const std::uint8_t> bytes) {
  Reader reader{bytes};
  PlaybackControl ask;
  const auto command = reader.take<std::uint8_t>();
  ask.speed = std::bit_cast<float>(reader.take<std::uint32_t>());
  const bool seeks = reader.take<std::uint8_t>() != 0;
  const auto to_ns = reader.take<std::uint64_t>();
  const auto length = reader.take<std::uint32_t>();
  ask.request = reader.rest(length);
  const auto wrong = [](const char* what) { return Unexpected{Problem{"playback control", what}}; };
  if (!reader.ok()) return wrong("its length does not fit its content");
  if (command > 1) return wrong("a command is 0, play, or 1, pause");
  if (!std::isfinite(ask.speed)) return wrong("the speed is no number");
  if (to_ns > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    return wrong("the time is beyond the year 2262");
  }
  ask.play = command == 0;
  if (seeks) ask.seek = UtcTime{static_cast<std::int64_t>(to_ns)};
  return Request{ask};
}

}  // namespace

std::string server_info_text(const ServerInfo& info) {
  json::Array capabilities;
  for (const char* const can : {"time", "parameters", "parametersSubscribe", "connectionGraph"})
    capabilities.json(json::quoted(can));
  if (info.playback) capabilities.json(R"("playbackControl")");
  json::Object text;
  text.text("op", "serverInfo")
      .text("name", info.name)
      .json("capabilities", capabilities.str())
      .text("sessionId", info.session);
  if (info.playback) {
    text.json("dataStartTime", time_json(info.playback->begin))
        .json("dataEndTime", time_json(info.playback->end));
  }
  return text.str();
}

std::string advertise_text(std::span<const ChannelRow> channels) {
  json::Array rows;
  for (const ChannelRow& row : channels) {
    rows.json(json::Object{}
                  .number("id", row.id)
                  .text("topic", row.topic)
                  .text("encoding", row.encoding)
                  .text("schemaName", row.schema_name)
                  .text("schemaEncoding", row.schema_encoding)
                  .text("schema", row.schema)
                  .str());
  }
  return json::Object{}.text("op", "advertise").json("channels", rows.str()).str();
}

std::string status_text(Level level, std::string_view message) {
  return json::Object{}
      .text("op", "status")
      .number("level", static_cast<int>(level))
      .text("message", message)
      .str();
}

std::string parameters_text(std::span<const Parameter> parameters, const std::string& request) {
  json::Array rows;
  for (const Parameter& parameter : parameters) {
    rows.json(json::Object{}
                  .text("name", parameter.name)
                  .number("value", parameter.value)
                  .text("type", "float64")
                  .str());
  }
  json::Object text;
  text.text("op", "parameterValues").json("parameters", rows.str());
  if (!request.empty()) text.text("id", request);
  return text.str();
}

std::string graph_text(std::span<const ChannelRow> channels, std::string_view publisher) {
  json::Array topics;
  for (const ChannelRow& row : channels) {
    topics.json(json::Object{}
                    .text("name", row.topic)
                    .json("publisherIds", json::Array{}.json(json::quoted(publisher)).str())
                    .str());
  }
  return json::Object{}
      .text("op", "connectionGraphUpdate")
      .json("publishedTopics", topics.str())
      .json("subscribedTopics", "[]")
      .json("advertisedServices", "[]")
      .json("removedTopics", "[]")
      .json("removedServices", "[]")
      .str();
}

std::array<std::uint8_t, kMessageHeader> message_header(std::uint32_t subscription, UtcTime at) {
  std::array<std::uint8_t, kMessageHeader> header{};
  header[0] = static_cast<std::uint8_t>(ServerOp::kMessageData);
  put(header.data() + 1, subscription);
  put(header.data() + 1 + sizeof subscription, at.ns);
  return header;
}

std::vector<std::uint8_t> time_bytes(UtcTime at) {
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(ServerOp::kTime)};
  append(bytes, at.ns);
  return bytes;
}

std::vector<std::uint8_t> playback_bytes(const PlaybackState& state) {
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(ServerOp::kPlaybackState),
                                  static_cast<std::uint8_t>(state.status)};
  append(bytes, state.at.ns);
  append(bytes, std::bit_cast<std::uint32_t>(state.speed));
  bytes.push_back(state.did_seek ? 1 : 0);
  append(bytes, static_cast<std::uint32_t>(state.request.size()));
  bytes.insert(bytes.end(), state.request.begin(), state.request.end());
  return bytes;
}

Result<Request, Problem> parse_text(std::string_view text) {
  const auto value = JsonValue::parse(text, "message");
  if (!value) return Unexpected{value.error()};
  const std::string op = value->text("op");
  if (op == "subscribe") return subscribe_of(*value);
  if (op == "unsubscribe") return unsubscribe_of(*value);
  if (op == "getParameters") return Request{GetParameters{names_of(*value), value->text("id")}};
  for (const bool ends : {false, true}) {
    const std::string subscribe = ends ? "unsubscribe" : "subscribe";
    if (op == subscribe + "ParameterUpdates")
      return Request{WatchParameters{names_of(*value), ends}};
    if (op == subscribe + "ConnectionGraph") return Request{WatchGraph{ends}};
  }
  for (const RefusableOp& row : kRefusable) {
    if (row.op == op) return Request{Refusable{row.capability}};
  }
  return Unexpected{Problem{
      "message", op.empty() ? "expected a field op" : "unknown op: " + op.substr(0, kNamed)}};
}

Result<Request, Problem> parse_binary(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return Unexpected{Problem{"message", "is empty"}};
  switch (static_cast<ClientOp>(bytes[0])) {
    case ClientOp::kMessageData:
      return Request{Refusable{"clientPublish"}};
    case ClientOp::kServiceCall:
      return Request{Refusable{"services"}};
    case ClientOp::kPlaybackControl:
      return playback_of(bytes.subspan(1));
  }
  return Unexpected{Problem{"message", "unknown binary op " + std::to_string(bytes[0])}};
}

}  // namespace pitwall::publishers::foxglove
