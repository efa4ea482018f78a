// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/black_box.hpp"

#include <array>
#include <cstdio>

#include "protocol/json/json_text.hpp"
#include "protocol/telemetry/registry/rows.hpp"
#include "protocol/vocabulary/check.hpp"
#include "vehicle/io/tick_inputs.hpp"

namespace pitwall::io {

Result<BlackBox, Problem> BlackBox::open(const std::string& folder, const BlackBoxFiles& files,
                                         bool no_base) {
  BlackBox box;
  if (folder.empty()) return box;
  recording::Metadata run = recorder::program_metadata("pitwall-vehicle");
  recorder::append_text(run, "car", files.car, files.car_text);
  recorder::append_file(run, "track", files.track);
  if (!files.bank.empty()) recorder::append_file(run, "bank", files.bank);
  run.emplace_back(kBaseKey, no_base ? kNoBase : "watched");
  auto started = recorder::Recorder::start(folder, std::move(run));
  if (!started) return Unexpected{started.error()};
  box.recorder_ = *std::move(started);
  return box;
}

void BlackBox::tick(const pipeline::Inputs& in, std::span<const can::Frame> sent) {
  if (!on()) return;
  counts_.frames_sent = sent.size();
  for (const can::ReceivedFrame& frame : in.can) recorder_->can(false, frame.at, frame.frame);
  for (const can::Frame& frame : sent) recorder_->can(true, in.now, frame);
  recorder_->tick(in.now, record_of(in, counts_));
  counts_ = {.number = counts_.number + 1};
}

void BlackBox::state(const telemetry::Snapshot& state, Instant now) {
  recorder_->state(state, telemetry::groups_of(telemetry::Direction::kDown), now);
}

void BlackBox::radio(bool down, Instant at, const recorder::RadioDatagram& datagram) {
  if (on()) recorder_->datagram(down, at, datagram);
}

void BlackBox::receiver(std::size_t unit, Instant at, std::span<const std::uint8_t> bytes) {
  if (!on() || bytes.empty()) return;
  recorder_->receiver(unit, at, bytes);
  counts_.receiver_bytes += bytes.size();
}

void BlackBox::event(std::string_view text, Instant at) {
  if (!on()) return;
  constexpr std::int64_t kNanosecondsPerMillisecond = 1'000'000;
  std::array<char, 256> json{};
  const int size =
      std::snprintf(json.data(), json.size(), R"({"type":"event","time_ms":%lld,"text":"%.*s"})",
                    static_cast<long long>(at.ns / kNanosecondsPerMillisecond),
                    static_cast<int>(text.size()), text.data());
  CHECK(size > 0 && static_cast<std::size_t>(size) < json.size());
  recorder_->text(recorder::Topic::kEvent, at, {json.data(), static_cast<std::size_t>(size)});
}

std::string BlackBox::json() const {
  json::Object out;
  if (!on()) return out.str();
  const recorder::RecorderFigures figures = recorder_->figures();
  out.number("records", figures.chain.records);
  out.number("dropped", figures.dropped);
  out.number("left_out", figures.left_out);
  out.number("lost", figures.chain.lost);
  out.number("interruptions", figures.chain.interruptions);
  out.number("segments", figures.chain.segments);
  out.number("lcm_events", figures.chain.lcm.events);
  out.number("lcm_lost", figures.chain.lcm.lost);
  out.number("bytes", figures.bytes());
  return out.str();
}

}  // namespace pitwall::io
