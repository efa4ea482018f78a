// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/recording.hpp"

#include <cstdio>

#include "basestation/outlets/wall/memory.hpp"
#include "basestation/replay/read_back.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::outlets::wall {
namespace {

std::string told(const replay::ReadBack& back, Duration took) {
  char text[160];
  std::snprintf(text, sizeof text, "known again: %llu messages of %.0f s, read in %.0f ms",
                static_cast<unsigned long long>(back.messages), (back.last - back.first).seconds(),
                took.milliseconds());
  return text;
}

}  // namespace

recording::Metadata run_metadata(int car, const std::string& name,
                                 const std::string& judgement_file) {
  recording::Metadata run = recorder::program_metadata("pitwall-base");
  run.emplace_back("car", std::to_string(car));
  run.emplace_back("name", name);
  recorder::append_file(run, "judgement", judgement_file);
  return run;
}

Result<std::unique_ptr<recorder::Recorder>, Problem> start_recording(
    const std::string& folder, recording::Metadata run, Wall* wall,
    const std::function<void(const std::string&)>& say) {
  for (const std::string& line : recorder::recover_folder(folder)) say(line);
  auto recorder = recorder::Recorder::start(folder, std::move(run));
  if (!recorder || wall == nullptr) return recorder;
  Memory memory{*wall};
  const Instant begun = transport::monotonic_now();
  const replay::ReadBack back =
      replay::read_back(folder, (*recorder)->clock(), begun, replay::kHistorySpan, memory);
  for (const std::string& problem : back.problems) say(problem);
  if (back.messages != 0) say(told(back, transport::monotonic_now() - begun));
  wall->room().record_with(
      [to = recorder->get()](std::string_view type, std::string_view json, Instant at) {
        if (const auto topic = recorder::topic_named(type)) to->text(*topic, at, json);
      });
  return recorder;
}

}  // namespace pitwall::outlets::wall
