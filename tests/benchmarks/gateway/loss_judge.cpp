// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/loss_judge.hpp"

#include <algorithm>
#include <optional>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::load {
namespace {

constexpr std::size_t kComplaintsMax = 10;

// Two receivers convert the same stamp of the kernel with clocks that they read apart.
constexpr Duration kStampError = microseconds(200);

class Judge {
 public:
  Judge(const Traffic& traffic, const LossEvidence& evidence)
      : traffic_(traffic), evidence_(evidence), times_reported_(traffic.omissions().size()) {
    CHECK(evidence.omitted_at.size() == traffic.omissions().size());
    for (const std::vector<Instant>& arrived : evidence.arrivals)
      last_.push_back(arrived.empty() ? Instant{INT64_MIN} : arrived.back());
    for (std::size_t i = 0; i < times_reported_.size(); ++i) {
      Instant& last = last_[traffic.omissions()[i].stream];
      last = std::max(last, evidence.omitted_at[i]);
    }
  }

  LossJudgement judge() {
    for (const can::LossReport& report : evidence_.reports) take(report);
    for (std::size_t i = 0; i < times_reported_.size(); ++i) {
      const Omission& omission = traffic_.omissions()[i];
      if (!expected(omission.stream)) continue;
      if (times_reported_[i] == 0 && is_hidden(omission.stream, evidence_.omitted_at[i])) {
        ++out_.hidden;
        continue;
      }
      ++out_.omitted;
      if (times_reported_[i] > 0) continue;
      ++out_.missed;
      complain("not reported", traffic_.streams()[omission.stream].row.id, evidence_.omitted_at[i]);
    }
    return out_;
  }

 private:
  bool expected(std::size_t stream) const {
    return !evidence_.of_car_only || traffic_.streams()[stream].of_car;
  }
  Duration period_of(std::size_t stream) const { return traffic_.streams()[stream].row.period; }

  void complain(const char* what, std::uint32_t id, Instant at) {
    if (out_.errors.size() == kComplaintsMax) return;
    out_.errors.push_back(std::string(what) + ": id " + std::to_string(id) + " due at " +
                          std::to_string(at.seconds()) + " s");
  }

  void take(const can::LossReport& report) {
    const auto stream = traffic_.stream_of(report.id);
    if (!stream || !expected(*stream)) {
      ++out_.false_reports;
      return complain("of no such message", report.id, report.due);
    }
    if (const auto omission = omission_of(*stream, report.due); omission && fits(report, *omission))
      return take(report, *omission);
    if (report.due > last_[*stream] + period_of(*stream) / 2) {
      ++out_.after_end;
    } else if (was_late(*stream, report.due)) {
      ++out_.late_on_bus;
    } else {
      ++out_.false_reports;
      complain("was not left out", report.id, report.due);
    }
  }

  // Single frames were left out; more can be missing at once where the next one was late too, or
  // never came because the traffic ended.
  bool fits(const can::LossReport& report, std::size_t omission) const {
    const std::size_t stream = traffic_.omissions()[omission].stream;
    return report.frames == 1 || evidence_.omitted_at[omission] == last_[stream] ||
           was_late(stream, report.due + period_of(stream));
  }

  void take(const can::LossReport& report, std::size_t omission) {
    const Instant due = evidence_.omitted_at[omission];
    if (++times_reported_[omission] > 1) {
      ++out_.twice;
      return complain("reported twice", report.id, due);
    }
    ++out_.reported;
    const Duration took = report.noticed - due;
    out_.worst = std::max(out_.worst, took);
    if (took <= kReportLimit)
      ++out_.in_time;
    else
      complain("reported late", report.id, due);
  }

  // Omissions of one message lie far apart, so a period either way decides without doubt. A second
  // report half a period away is of the frame before or after.
  std::optional<std::size_t> omission_of(std::size_t stream, Instant due) const {
    const Duration near = period_of(stream);
    for (std::size_t i = 0; i < times_reported_.size(); ++i) {
      if (traffic_.omissions()[i].stream != stream) continue;
      const Duration off = due - evidence_.omitted_at[i];
      const Duration distance = off < Duration{} ? -off : off;
      if (distance < (times_reported_[i] == 0 ? near : near / 2)) return i;
    }
    return std::nullopt;
  }

  bool was_late(std::size_t stream, Instant due) const {
    const std::vector<Instant>& arrived = evidence_.arrivals[stream];
    const Duration slack = can::tolerance_of(traffic_.streams()[stream].row);
    const auto next = std::lower_bound(arrived.begin(), arrived.end(), due - period_of(stream) / 2);
    return next == arrived.end() || *next > due + slack - kStampError;
  }

  bool is_hidden(std::size_t stream, Instant omitted_at) const {
    const can::MessageRow& row = traffic_.streams()[stream].row;
    const std::vector<Instant>& arrived = evidence_.arrivals[stream];
    const auto next = std::lower_bound(arrived.begin(), arrived.end(), omitted_at);
    if (row.has_counter || next == arrived.begin() || next == arrived.end()) return false;
    return *next - *(next - 1) <= row.period + can::tolerance_of(row) + kStampError;
  }

  const Traffic& traffic_;
  const LossEvidence& evidence_;
  std::vector<std::uint32_t> times_reported_;
  std::vector<Instant> last_;  // frame of each stream, arrived or left out
  LossJudgement out_;
};

}  // namespace

LossJudgement judge_losses(const Traffic& traffic, const LossEvidence& evidence) {
  return Judge{traffic, evidence}.judge();
}

}  // namespace pitwall::load
