// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/judge_again.hpp"

#include <algorithm>

#include "basestation/outlets/wall/judge_text.hpp"
#include "basestation/outlets/wall/wall_texts.hpp"
#include "basestation/replay/segment_reader.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::outlets::wall {
void JudgeAgain::state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
                       Instant received) {
  if (watch_) {
    watch_->advance(picture_, received);
    watch_->heard(received);
  }
  picture_.update(state, groups);
}

void JudgeAgain::text(recorder::Topic topic, Instant at, std::string_view json) {
  using enum recorder::Topic;
  if (topic == kJudge) {
    auto settings = read_judge_text(json);
    if (!settings) return compare(json, to_string(settings.error()));
    if (!settings->begins) return;
    watch_.emplace(std::move(settings->config));
    line_ = 0;
    return;
  }
  if (!watch_ || (topic != kInput && topic != kAlarms && topic != kAlarmEvent)) return;
  watch_->advance(picture_, at);
  if (topic == kInput) {
    const auto input = read_input_text(json, at);
    if (!input) return compare(json, to_string(input.error()));
    // What was refused then is refused now.
    static_cast<void>(watch_->take(*input));
  }
  if (topic == kAlarms) {
    ++lists_;
    compare(json, alarms_text(watch_->alarms()));
  }
  if (topic == kAlarmEvent) compare_line(json);
}

void JudgeAgain::compare_line(std::string_view told) {
  ++lines_;
  ++line_;
  const auto& history = watch_->alarms().history();
  const auto line = std::ranges::find(history, line_, &alarms::AlarmEvent::number);
  compare(told, line == history.end() ? "nothing" : alarm_event_text(*line));
}

void JudgeAgain::compare(std::string_view told, const std::string& again) {
  if (told == again) return;
  ++different_;
  if (differences_.size() < kListed)
    differences_.push_back("told: " + std::string{told} + "\nagain: " + again);
}

Result<JudgeAgain, Problem> judge_again(const std::string& folder, std::vector<std::string>& say) {
  const auto paths = recorder::segments_of(folder);
  if (!paths) return Unexpected{paths.error()};
  JudgeAgain judge;
  telemetry::Snapshot known;
  for (const std::string& path : *paths) {
    const auto file = transport::read_file(path);
    if (!file) {
      say.push_back(to_string(file.error()));
      continue;
    }
    recording::McapReader head{as_bytes(*file)};
    head.next();
    const auto clock = recorder::clock_of(head.run());
    if (!clock) {
      say.push_back(path + ": no recording of a base station");
      continue;
    }
    replay::SegmentReader reader{as_bytes(*file), *clock, known};
    while (reader.due()) reader.step(judge);
  }
  if (!judge.judged()) return Unexpected{Problem{folder, "no base that judged recorded it"}};
  return judge;
}

}  // namespace pitwall::outlets::wall
