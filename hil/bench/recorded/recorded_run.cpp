// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/recorded_run.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "protocol/recorder/can_record.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::bench {
namespace {

constexpr std::string_view kReceiverTopic = "/gnss/";

std::string count_of(std::size_t had, std::size_t wanted, const char* what) {
  return std::to_string(had) + " of " + std::to_string(wanted) + " " + what + " are recorded";
}

}  // namespace

struct RecordedRun::Segment {
  std::string path, bytes;
  recording::McapReader reader;

  Segment(std::string file, std::string content)
      : path(std::move(file)), bytes(std::move(content)), reader(as_bytes(bytes)) {}
};

Result<RecordedRun, Problem> RecordedRun::open(const std::string& path) {
  RecordedRun run;
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    auto files = recorder::segments_of(path);
    if (!files) return Unexpected{files.error()};
    if (files->empty()) return Unexpected{Problem{path, "no recording is in this folder"}};
    run.files_ = *std::move(files);
  } else {
    run.files_ = {path};
  }
  for (const std::string& file : run.files_) {
    const std::uintmax_t bytes = std::filesystem::file_size(file, none);
    if (!none) run.size_ += bytes;
  }
  const auto opened = run.open_next();
  if (!opened) return Unexpected{opened.error()};
  return run;
}

Result<bool, Problem> RecordedRun::open_next() {
  if (opened_ == files_.size()) return false;
  const std::string& path = files_[opened_++];
  auto bytes = transport::read_file(path);
  if (!bytes) return Unexpected{bytes.error()};
  if (segment_) done_before_ += segment_->bytes.size();
  segment_ = std::make_shared<Segment>(path, *std::move(bytes));
  places_.clear();
  waiting_ = segment_->reader.next();  // what is in front of it, the clock, is known now
  if (!waiting_) return Unexpected{Problem{path, to_string(segment_->reader.end())}};
  const auto clock = recorder::clock_of(segment_->reader.run());
  if (!clock) return Unexpected{Problem{path, "not a recording of a car or a base"}};
  clock_ = *clock;
  run_ = segment_->reader.run();
  return true;
}

std::optional<recording::McapMessage> RecordedRun::next_message() {
  if (waiting_) return std::exchange(waiting_, std::nullopt);
  return segment_->reader.next();
}

Result<std::optional<RecordedTick>, Problem> RecordedRun::next() {
  while (true) {
    if (is_over_) return std::optional<RecordedTick>{};
    while (const auto message = next_message()) {
      std::optional<RecordedTick> before;
      if (place_of(message->channel).kind == Kind::kTick)
        before = std::exchange(finished_, std::nullopt);
      if (const auto wrong = take(*message)) return Unexpected{*wrong};
      if (before || is_over_) return before;
    }
    const recording::McapReader& reader = segment_->reader;
    if (reader.end() != recording::McapEnd::kComplete && remarked_ < opened_) {
      remarked_ = opened_;
      remarks_.push_back(segment_->path + ": byte " + std::to_string(reader.place()) + ": " +
                         to_string(reader.end()));
    }
    const auto opened = open_next();
    if (!opened) return Unexpected{opened.error()};
    if (*opened) continue;
    if (number_ == 0)
      return Unexpected{Problem{files_.front(),
                                "holds no ticks of a car: recorded by a base, or by a car of "
                                "another version"}};
    return std::exchange(finished_, std::nullopt);
  }
}

const RecordedRun::Place& RecordedRun::place_of(std::uint16_t channel) {
  const auto found = places_.find(channel);
  if (found != places_.end()) return found->second;
  const recording::Channel& here = segment_->reader.channels().at(channel);
  Place place;
  if (here.topic == recorder::kReceivedTopic) place.kind = Kind::kReceived;
  if (here.topic == recorder::kSentTopic) place.kind = Kind::kSent;
  if (here.topic == recorder::kTickTopic) place.kind = Kind::kTick;
  if (here.topic.starts_with(kReceiverTopic)) {
    place.kind = Kind::kReceiver;
    place.unit = here.topic.ends_with("1") ? 1 : 0;
  }
  if (place.kind == Kind::kOther) {
    place.fields = recorder::ChannelFields::of(here);
    if (place.fields && !place.fields->is_snapshot()) place.kind = Kind::kState;
  }
  return places_.emplace(channel, std::move(place)).first->second;
}

std::optional<Problem> RecordedRun::take(const recording::McapMessage& message) {
  const Place& place = place_of(message.channel);
  switch (place.kind) {
    case Kind::kOther:
      return std::nullopt;
    case Kind::kReceiver:
      collected_.receivers.push_back(
          {place.unit, at(message.logged_ns), {message.data.begin(), message.data.end()}});
      return std::nullopt;
    case Kind::kTick:
      return take_tick(message);
    case Kind::kReceived:
    case Kind::kSent: {
      const auto frame = recorder::decode_frame(message.data);
      if (!frame) return problem(frame.error());
      if (place.kind == Kind::kSent) {
        collected_.sent.push_back(*frame);
      } else {
        collected_.received.push_back({*frame, at(message.logged_ns)});
      }
      return std::nullopt;
    }
    case Kind::kState: {
      const auto group = place.fields->group();
      if (!group || !finished_) return std::nullopt;  // what was known before the first tick
      if (!finished_->state) finished_->state.emplace();
      finished_->state->at = at(message.logged_ns);
      if (!place.fields->decode(message.data, finished_->state->values))
        return problem("a message of the vehicle state cannot be decoded");
      finished_->state->groups.add(*group);
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<Problem> RecordedRun::take_tick(const recording::McapMessage& message) {
  RecordedTick tick = std::exchange(collected_, {});
  tick.now = at(message.logged_ns);
  if (!recording::from_cdr(message.data, tick.given))
    return problem("a tick cannot be decoded: recorded by another version");
  if (tick.given.number == 0 && number_ > 0) {
    is_over_ = true;
    remarks_.push_back(segment_->path + ": another run begins here, compare it alone");
    return std::nullopt;
  }
  if (tick.given.number != number_)
    return problem("tick " + std::to_string(number_) + " is not recorded, the next is " +
                   std::to_string(tick.given.number));
  if (const auto lacks = incomplete(tick)) return lacks;
  if (number_ == 0) begun_ = tick.now;
  ++number_;
  finished_ = std::move(tick);
  return std::nullopt;
}

std::optional<Problem> RecordedRun::incomplete(const RecordedTick& tick) const {
  std::size_t bytes = 0;
  for (const ReceiverBytes& some : tick.receivers) bytes += some.bytes.size();
  const recorder::TickRecord& given = tick.given;
  const std::string number = "tick " + std::to_string(given.number) + ": ";
  if (tick.received.size() != given.frames_received)
    return problem(number +
                   count_of(tick.received.size(), given.frames_received, "received frames"));
  if (tick.sent.size() != given.frames_sent)
    return problem(number + count_of(tick.sent.size(), given.frames_sent, "sent frames"));
  if (bytes != given.receiver_bytes)
    return problem(number + count_of(bytes, given.receiver_bytes, "bytes of receivers"));
  return std::nullopt;
}

std::size_t RecordedRun::done() const { return done_before_ + segment_->reader.message_place(); }

Problem RecordedRun::problem(const std::string& what) const { return {segment_->path, what}; }

Instant RecordedRun::at(std::uint64_t file_ns) const {
  return clock_.to_base(Instant{static_cast<std::int64_t>(file_ns)});
}

std::string RecordedRun::metadata(const std::string& key) const {
  const auto found = std::ranges::find(run_, key, [](const auto& pair) { return pair.first; });
  return found == run_.end() ? std::string{} : found->second;
}

}  // namespace pitwall::bench
