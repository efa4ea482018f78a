// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/event_log.hpp"

#include "protocol/vocabulary/check.hpp"

namespace pitwall::recording {
namespace {

constexpr std::string_view kEventSchema =
    R"({"type":"object","properties":{"name":{"type":"string"},"text":{"type":"string"}},)"
    R"("required":["name","text"]})";

void append(std::vector<std::uint8_t>& out, std::string_view text) {
  out.insert(out.end(), text.begin(), text.end());
}

void append_json_string(std::vector<std::uint8_t>& out, std::string_view text) {
  out.push_back('"');
  for (const char c : text) {
    if (c == '"' || c == '\\') out.push_back('\\');
    out.push_back(static_cast<std::uint8_t>(c >= ' ' && c <= '~' ? c : '?'));
  }
  out.push_back('"');
}

}  // namespace

EventLog::EventLog(Metadata run, Sink sink, McapLimits limits)
    : run_(std::move(run)), sink_(std::move(sink)), limits_(limits) {
  event_.reserve(2 * (kEventNameMax + kEventTextMax) + kEventSchema.size());
  add({std::string{kEventTopic},
       "json",
       {"pitwall_msgs/msg/Event", "jsonschema", std::string{kEventSchema}},
       {}});
}

ChannelId EventLog::add(Channel channel) {
  CHECK(!writer_);
  channels_.push_back(std::move(channel));
  return {static_cast<std::uint16_t>(channels_.size() - 1)};
}

void EventLog::start() {
  CHECK(!writer_);
  const auto hashed = [this](std::span<const std::uint8_t> bytes) {
    if (!sink_(bytes)) return false;
    hash_.update(bytes);
    return true;
  };
  writer_ = std::make_unique<McapWriter>(channels_, run_, hashed, limits_);
}

bool EventLog::event(Instant at, std::string_view name, std::string_view text) {
  event_.clear();
  append(event_, R"({"name":)");
  append_json_string(event_, name.substr(0, kEventNameMax));
  append(event_, R"(,"text":)");
  append_json_string(event_, text.substr(0, kEventTextMax));
  append(event_, "}");
  return write({0}, at, event_);
}

bool EventLog::write(ChannelId channel, Instant at, std::span<const std::uint8_t> data) {
  CHECK(writer_);
  return writer_->write(channel, at, data);
}

bool EventLog::flush() {
  CHECK(writer_);
  return writer_->flush();
}

bool EventLog::close() {
  CHECK(writer_);
  return writer_->close();
}

bits::Sha256::Digest EventLog::digest() const { return hash_.digest(); }

McapCounters EventLog::counters() const { return writer_ ? writer_->counters() : McapCounters{}; }

}  // namespace pitwall::recording
