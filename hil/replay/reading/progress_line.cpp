// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/reading/progress_line.hpp"

#include <algorithm>
#include <utility>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::replay {
namespace {

constexpr int kErrors = 2;
constexpr Duration kSilence = milliseconds(500), kTerminalPause = milliseconds(250),
                   kLinePause = seconds(1);
constexpr double kMebibyte = 1'048'576.0, kGibibyte = 1'073'741'824.0;
constexpr std::string_view kToBegin = "\r\x1B[K";  // and the rest of the line is cleared

std::string size_text(std::size_t bytes) {
  const auto size = static_cast<double>(bytes);
  return size < kGibibyte ? formatted("%.1f MiB", size / kMebibyte)
                          : formatted("%.1f GiB", size / kGibibyte);
}

ProgressPace pace_of(bool is_terminal) {
  return is_terminal ? ProgressPace{kSilence, kTerminalPause} : ProgressPace{{}, kLinePause};
}

}  // namespace

std::string progress_text(std::string_view what, std::size_t done, std::size_t all,
                          Duration spent) {
  const double part =
      all == 0 ? 1.0 : std::min(1.0, static_cast<double>(done) / static_cast<double>(all));
  std::string out =
      std::string(what) + formatted(": %.0f %% of %s", part * 100.0, size_text(all).c_str());
  if (part > 0.0) out += formatted(", %.0f s left", spent.seconds() * (1.0 - part) / part);
  return out;
}

bool ProgressPace::is_due(Duration spent) {
  if (spent < silence_ || (last_ && spent.ns - last_->ns < pause_.ns)) return false;
  last_ = spent;
  return true;
}

ProgressLine::ProgressLine(std::string what, bool is_asked_for)
    : ProgressLine(std::move(what), is_asked_for, transport::monotonic_now) {}

ProgressLine::ProgressLine(std::string what, bool is_asked_for, Clock clock)
    : what_(std::move(what)),
      is_terminal_(transport::is_terminal(kErrors)),
      is_asked_for_(is_asked_for),
      clock_(std::move(clock)),
      begin_(clock_()),
      pace_(pace_of(is_terminal_)) {}

ProgressLine::~ProgressLine() {
  if (is_shown_ && is_terminal_) transport::write_to(kErrors, kToBegin);
}

ReadProgress ProgressLine::function() {
  if (!is_terminal_ && !is_asked_for_) return {};
  return [this](std::size_t done, std::size_t all) { show(done, all); };
}

void ProgressLine::show(std::size_t done, std::size_t all) {
  const Duration spent = clock_() - begin_;
  if (!pace_.is_due(spent)) return;
  is_shown_ = true;
  const std::string text = progress_text(what_, done, all, spent);
  transport::write_to(kErrors, is_terminal_ ? std::string(kToBegin) + text : text + "\n");
}

}  // namespace pitwall::replay
