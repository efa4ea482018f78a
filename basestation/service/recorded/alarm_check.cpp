// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/recorded/alarm_check.hpp"

#include <algorithm>

#include "basestation/replay/segment_reader.hpp"
#include "basestation/service/messages/evaluator_text.hpp"
#include "basestation/service/messages/message_text.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::service {
void AlarmCheck::state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
                       Instant received) {
  if (evaluator_) {
    evaluator_->advance(vehicle_, received);
    evaluator_->receive(received);
  }
  vehicle_.update(state, groups);
}

void AlarmCheck::text(recorder::Topic topic, Instant at, std::string_view json) {
  using enum recorder::Topic;
  if (topic == kJudge) {
    auto settings = read_judge_text(json);
    if (!settings) return compare(json, to_string(settings.error()));
    if (!settings->begins) return;
    evaluator_.emplace(std::move(settings->config));
    line_ = 0;
    return;
  }
  if (!evaluator_ || (topic != kInput && topic != kAlarms && topic != kAlarmEvent)) return;
  evaluator_->advance(vehicle_, at);
  if (topic == kInput) {
    const auto input = read_input_text(json, at);
    if (!input) return compare(json, to_string(input.error()));
    // What was refused then is refused now.
    static_cast<void>(evaluator_->take(*input));
  }
  if (topic == kAlarms) {
    ++lists_;
    compare(json, alarms_text(evaluator_->alarms()));
  }
  if (topic == kAlarmEvent) compare_line(json);
}

void AlarmCheck::compare_line(std::string_view reported) {
  ++lines_;
  ++line_;
  const auto& history = evaluator_->alarms().history();
  const auto line = std::ranges::find(history, line_, &alarms::AlarmEvent::number);
  compare(reported, line == history.end() ? "nothing" : alarm_event_text(*line));
}

void AlarmCheck::compare(std::string_view reported, const std::string& again) {
  if (reported == again) return;
  ++different_;
  if (differences_.size() < kListed)
    differences_.push_back("told: " + std::string{reported} + "\nagain: " + again);
}

Result<AlarmCheck, Problem> check_alarms(const std::string& folder, std::vector<std::string>& log) {
  const auto paths = recorder::segments_of(folder);
  if (!paths) return Unexpected{paths.error()};
  AlarmCheck judge;
  telemetry::Snapshot known;
  for (const std::string& path : *paths) {
    const auto file = transport::read_file(path);
    if (!file) {
      log.push_back(to_string(file.error()));
      continue;
    }
    recording::McapReader head{as_bytes(*file)};
    head.next();
    const auto clock = recorder::clock_of(head.run());
    if (!clock) {
      log.push_back(path + ": no recording of a base station");
      continue;
    }
    replay::SegmentReader reader{as_bytes(*file), *clock, known};
    while (reader.due()) reader.step(judge);
  }
  if (!judge.judged())
    return Unexpected{Problem{folder, "not the recording of a base that judged alarms"}};
  return judge;
}

}  // namespace pitwall::service
