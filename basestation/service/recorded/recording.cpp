// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/recorded/recording.hpp"

#include <cstdio>

#include "basestation/replay/read_back.hpp"
#include "basestation/service/messages/evaluator_text.hpp"
#include "basestation/service/recorded/restored_log.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/realtime.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::service {
namespace {

std::string reported(const replay::ReadBack& back, Duration took) {
  return formatted("restored: %llu messages of %.0f s, read in %.0f ms",
                   static_cast<unsigned long long>(back.messages),
                   (back.last - back.first).seconds(), took.milliseconds());
}

// How the recorder is, looked at once a second.
class RecorderWatch {
 public:
  explicit RecorderWatch(const recorder::Recorder& recorder) : recorder_(&recorder) {}

  void operator()(state::BaseFigures& base, Instant now) {
    if (now >= due_) {
      figures_ = recorder_->figures();
      due_ = now + kEvery;
    }
    const bool works = figures_.chain.recording || figures_.chain.problem.empty();
    base.recording = works ? kRecords : kDiskTakesNothing;
    base.disk_minutes = works ? figures_.minutes_left() : 0.0;
    base.recorder_lost = static_cast<double>(figures_.lost());
    base.recorder_kbyte_s = figures_.bytes_per_s / kBytesPerKilobyte;
  }

 private:
  static constexpr Duration kEvery = seconds(1);
  static constexpr double kRecords = 1.0, kDiskTakesNothing = 2.0;  // kRecordingStates
  static constexpr double kBytesPerKilobyte = 1e3;

  const recorder::Recorder* recorder_;
  recorder::RecorderFigures figures_;
  Instant due_{};
};

// What is told to consoles, and what the judge is told: all that decides the list of alarms.
void record(CarService& car, recorder::Recorder& to, Instant now) {
  using recorder::Topic;
  car.messages().subscribe([&to](std::string_view type, std::string_view json, Instant at) {
    if (const auto topic = recorder::topic_named(type)) to.text(*topic, at, json);
  });
  const alarms::Evaluator& evaluator = car.evaluator();
  to.text(Topic::kJudge, now, judge_text(evaluator, true, now));
  car.observe_inputs([&to, &evaluator](const alarms::EvaluatorInput& input, Instant at) {
    to.text(Topic::kInput, at, input_text(input, at));
    const bool edit = std::holds_alternative<alarms::LimitEdit>(input) ||
                      std::holds_alternative<alarms::AlarmEdit>(input);
    if (edit) to.text(Topic::kJudge, at, judge_text(evaluator, false, at));
  });
  car.watch_recorder(RecorderWatch{to});
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
    const std::string& folder, recording::Metadata run, CarService& car,
    const std::function<void(const std::string&)>& log) {
  for (const std::string& line : recorder::recover_folder(folder)) log(line);
  auto recorder = recorder::Recorder::start(folder, std::move(run));
  if (!recorder) return recorder;
  LogReader reader{car};
  const Instant begun = transport::monotonic_now();
  const replay::ReadBack back =
      replay::read_back(folder, (*recorder)->clock(), begun, replay::kHistorySpan, reader);
  for (const std::string& problem : back.problems) log(problem);
  if (back.messages != 0) log(reported(back, transport::monotonic_now() - begun));
  record(car, **recorder, begun);
  if (const auto restored = reader.entries().result(begun))
    car.restore(restored->entries, restored->fuel_left_l, begun);
  transport::return_free_memory();  // that reading it took
  return recorder;
}

}  // namespace pitwall::service
