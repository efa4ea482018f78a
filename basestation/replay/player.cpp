// SPDX-License-Identifier: Apache-2.0
#include "basestation/replay/player.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::replay {
namespace {

// A person sees no more than this of a race that runs backwards.
constexpr Duration kBackwardStep = milliseconds(100);
// After a jump so many lines of history are told at most.
constexpr std::size_t kHistory = 1'000;

// Texts that say how things are, of which the newest is enough; the others are lines of a history.
bool is_standing(recorder::Topic topic) {
  using enum recorder::Topic;
  return topic == kHello || topic == kAlarms || topic == kAuthority || topic == kFuel ||
         topic == kJudge || topic == kExpected || topic == kSettings;
}
// So often that the next one comes soon after any jump.
bool is_frequent(recorder::Topic topic) {
  using enum recorder::Topic;
  return topic == kLink || topic == kJoystick || topic == kRecorder || topic == kInput;
}

class TextCollector : public Listener {
 public:
  using Keep = std::function<void(recorder::Topic, Instant, std::string_view)>;

  TextCollector(Keep keep, Listener* index) : keep_(std::move(keep)), index_(index) {}
  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant at) override {
    if (index_ != nullptr) index_->state(state, groups, at);
  }
  void text(recorder::Topic topic, Instant at, std::string_view json) override {
    if (!is_frequent(topic)) keep_(topic, at, json);
  }
  void restart(Instant) override {}

 private:
  Keep keep_;
  Listener* index_;
};

}  // namespace

Result<Player, Problem> Player::open(const std::string& folder, Listener* index) {
  const auto paths = recorder::segments_of(folder);
  if (!paths) return Unexpected{paths.error()};
  Player player;
  for (const std::string& path : *paths) player.add(path, index);
  if (player.segments_.empty()) {
    std::string what = "no recording of a base station in it";
    for (const std::string& problem : player.problems_) what += "; " + problem;
    return Unexpected{Problem{folder, what}};
  }
  std::ranges::stable_sort(player.segments_, {}, &Segment::begin);
  std::ranges::stable_sort(player.texts_, {}, &Text::at);
  player.begin_ = player.now_ = player.segments_.front().begin;
  for (const Segment& segment : player.segments_) {
    player.end_ = std::max(player.end_, segment.end);
  }
  player.load(0);
  return player;
}

// Reads it once: when it begins and ends, and its texts.
bool Player::add(const std::string& path, Listener* index) {
  const auto file = transport::read_file(path);
  if (!file) return problems_.push_back(to_string(file.error())), false;
  recording::McapReader head{as_bytes(*file)};
  head.next();
  const auto clock = recorder::clock_of(head.run());
  if (!clock) return problems_.push_back(path + ": no recording of a base station"), false;
  if (segments_.empty()) {
    clock_ = *clock;
    run_ = head.run();
  }
  telemetry::Snapshot known;
  SegmentReader reader{as_bytes(*file), clock_, known};
  Segment segment{.path = path};
  bool any = false;
  TextCollector texts{[this](recorder::Topic topic, Instant at, std::string_view json) {
                        texts_.push_back({topic, at, std::string{json}});
                      },
                      index};
  for (; const auto due = reader.due(); any = true) {
    segment.begin = any ? std::min(segment.begin, *due) : *due;
    segment.end = any ? std::max(segment.end, *due) : *due;
    reader.step(texts);
  }
  if (reader.unreadable() != 0) {
    problems_.push_back(path + ": " + std::to_string(reader.unreadable()) +
                        " messages that this version does not read");
  }
  if (any) segments_.push_back(std::move(segment));
  return any;
}

void Player::load(std::size_t segment) {
  current_ = segment;
  auto file = transport::read_file(segments_[segment].path);
  reader_.reset();
  *file_ = file ? *std::move(file) : std::string{};
  if (!file) problems_.push_back(to_string(file.error()));
  reader_ = std::make_unique<SegmentReader>(as_bytes(*file_), clock_, *known_);
}

void Player::set_speed(double speed) {
  if (std::isnan(speed)) return;
  speed_ =
      speed == 0.0 ? 0.0 : std::copysign(std::clamp(std::abs(speed), kSlowest, kFastest), speed);
}

void Player::jump(Instant to, Listener& listener) {
  to = std::clamp(to, begin_, end_);
  std::size_t segment = 0;
  while (segment + 1 < segments_.size() && segments_[segment + 1].begin <= to) ++segment;
  *known_ = {};
  load(segment);
  listener.restart(to);
  tell_texts_until(to, listener);
  const bool restored = reader_->restore(to, listener);
  now_ = to;
  behind_ = {};
  // The texts have been told.
  class OnlyState : public Listener {
   public:
    explicit OnlyState(Listener& inner) : inner_(inner) {}
    void state(const telemetry::Snapshot& s, telemetry::GroupSet groups, Instant at) override {
      inner_.state(s, groups, at);
    }
    void text(recorder::Topic topic, Instant at, std::string_view json) override {
      if (is_frequent(topic)) inner_.text(topic, at, json);
    }
    void restart(Instant) override {}

   private:
    Listener& inner_;
  } only_state{listener};
  if (!restored) problems_.push_back(segments_[segment].path + ": no picture to begin with");
  tell_until(to, only_state);
}

void Player::advance(Duration passed, Listener& listener) {
  const Duration step = from_seconds(passed.seconds() * speed_);
  if (step.ns < 0) {
    behind_ = behind_ - step;
    if (behind_ >= kBackwardStep && now_ > begin_) jump(now_ - behind_, listener);
    return;
  }
  const Instant to = std::min(now_ + step, end_);
  tell_until(to, listener);
  now_ = to;
}

void Player::tell_texts_until(Instant to, Listener& listener) {
  const auto end = std::ranges::upper_bound(texts_, to, {}, &Text::at);
  std::array<bool, recorder::kTopics> reported{};
  std::vector<const Text*> chosen;
  for (auto text = end; text != texts_.begin() && chosen.size() < kHistory;) {
    --text;
    const auto topic = static_cast<std::size_t>(text->topic);
    if (is_standing(text->topic) && reported[topic]) continue;
    reported[topic] = true;
    chosen.push_back(&*text);
  }
  for (auto text = chosen.rbegin(); text != chosen.rend(); ++text) {
    listener.text((*text)->topic, (*text)->at, (*text)->json);
  }
}

void Player::tell_until(Instant to, Listener& listener) {
  while (true) {
    const auto due = reader_->due();
    if (!due) {
      if (current_ + 1 == segments_.size()) return;
      load(current_ + 1);
    } else if (*due > to) {
      return;
    } else {
      reader_->step(listener);
    }
  }
}

}  // namespace pitwall::replay
