// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_summary.hpp"

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::replay {
namespace {

std::string count(std::uint64_t n) { return std::to_string(n); }
std::int64_t whole_us(Duration d) { return d.ns / 1'000; }
std::string in_us(Duration d) { return std::to_string(whole_us(d)); }

// "can0 1A0 due at 1.234567 s"
std::string name_of(const DroppedFrame& dropped, const Timeline& timeline) {
  const BusTrack& bus = timeline.buses[dropped.bus];
  const can::Frame& frame = bus.frames[dropped.frame];
  const int digits = frame.extended ? 8 : 3;
  return bus.interface + formatted(" %0*X", digits, frame.id) + " due at " +
         std::to_string(bus.due[dropped.frame].seconds()) + " s of pass " +
         count(dropped.pass + 1ULL);
}

std::string drops_text(const PlayReport& report, const Timeline& timeline) {
  if (report.dropped() == 0) return {};
  std::string out = "dropped " + count(report.dropped()) +
                    " frames: " + count(report.dropped_late) + " too late, " +
                    count(report.dropped_full) + " queue full, " + count(report.dropped_refused) +
                    " refused by the kernel\n";
  for (const DroppedFrame& dropped : report.dropped_list)
    out += "  " + name_of(dropped, timeline) + ", late by " + in_us(dropped.late) + " us\n";
  if (report.dropped() > report.dropped_list.size()) out += "  and more\n";
  return out;
}

std::string drops_json(const PlayReport& report, const Timeline& timeline) {
  json::Array out;
  for (const DroppedFrame& dropped : report.dropped_list) {
    const BusTrack& bus = timeline.buses[dropped.bus];
    out.json(json::Object{}
                 .number("pass", dropped.pass + 1ULL)
                 .number("id", bus.frames[dropped.frame].id)
                 .number("due_us", whole_us(bus.due[dropped.frame]))
                 .number("late_us", whole_us(dropped.late))
                 .str());
  }
  return out.str();
}

}  // namespace

std::string to_text(const PlayReport& report, const Timeline& timeline) {
  const LatenessHistogram& late = report.lateness;
  std::string out = "sent " + count(report.sent) + " frames in " +
                    std::to_string(report.took.seconds()) + " s (" + count(report.calls) +
                    " calls, " + count(report.waits) + " sleeps, " + count(report.retries) +
                    " retries, " + count(report.dropped()) + " dropped)\n";
  if (late.count() > 0)
    out += "lateness p50 " + in_us(late.quantile(0.5)) + " us, p90 " + in_us(late.quantile(0.9)) +
           " us, p99 " + in_us(late.quantile(0.99)) + " us, max " + in_us(late.latest()) + " us\n";
  if (report.seam_error.ns > 0)
    out += "gaps between passes wrong by " + in_us(report.seam_error) + " us at most\n";
  out += drops_text(report, timeline);
  if (report.aborted) out += "aborted: a frame was later than allowed\n";
  if (report.stopped) out += "stopped by a signal\n";
  return out;
}

std::string to_json(const PlayReport& report, const Timeline& timeline,
                    const transport::RealtimeReport& realtime) {
  const LatenessHistogram& late = report.lateness;
  json::Object out;
  out.text("verb", "replay")
      .number("frames_per_pass", timeline.frames)
      .number("sent", report.sent)
      .number("took_us", whole_us(report.took))
      .number("calls", report.calls)
      .number("sleeps", report.waits)
      .number("retries", report.retries)
      .number("dropped_late", report.dropped_late)
      .number("dropped_full", report.dropped_full)
      .number("dropped_refused", report.dropped_refused)
      .json("dropped_first", drops_json(report, timeline));
  if (late.count() > 0)
    out.json("late_us", json::Object{}
                            .number("p50", whole_us(late.quantile(0.5)))
                            .number("p90", whole_us(late.quantile(0.9)))
                            .number("p99", whole_us(late.quantile(0.99)))
                            .number("max", whole_us(late.latest()))
                            .str());
  return out.number("seam_error_us", whole_us(report.seam_error))
             .flag("aborted", report.aborted)
             .flag("stopped", report.stopped)
             .flag("memory_locked", realtime.memory_locked)
             .flag("fifo", realtime.fifo)
             .str() +
         "\n";
}

}  // namespace pitwall::replay
