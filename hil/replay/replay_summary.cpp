// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_summary.hpp"

#include <array>
#include <cstdio>

namespace pitwall::replay {
namespace {

std::string count(std::uint64_t n) { return std::to_string(n); }
std::string in_us(Duration d) { return std::to_string(d.ns / 1'000); }

// "can0 1A0 due at 1.234567 s"
std::string name_of(const DroppedFrame& dropped, const Timeline& timeline) {
  const BusTrack& bus = timeline.buses[dropped.bus];
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), bus.frames[dropped.frame].extended ? " %08X" : " %03X",
                bus.frames[dropped.frame].id);
  return bus.interface + text.data() + " due at " +
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
  std::string out;
  for (const DroppedFrame& dropped : report.dropped_list) {
    const BusTrack& bus = timeline.buses[dropped.bus];
    out += std::string(out.empty() ? "" : ",") + "{\"pass\":" + count(dropped.pass + 1ULL) +
           ",\"id\":" + count(bus.frames[dropped.frame].id) +
           ",\"due_us\":" + in_us(bus.due[dropped.frame]) + ",\"late_us\":" + in_us(dropped.late) +
           "}";
  }
  return "[" + out + "]";
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
  const auto truth = [](bool value) { return value ? "true" : "false"; };
  std::string out = "{\"verb\":\"replay\",\"frames_per_pass\":" + count(timeline.frames) +
                    ",\"sent\":" + count(report.sent) + ",\"took_us\":" + in_us(report.took) +
                    ",\"calls\":" + count(report.calls) + ",\"sleeps\":" + count(report.waits) +
                    ",\"retries\":" + count(report.retries);
  out += ",\"dropped_late\":" + count(report.dropped_late) +
         ",\"dropped_full\":" + count(report.dropped_full) +
         ",\"dropped_refused\":" + count(report.dropped_refused) +
         ",\"dropped_first\":" + drops_json(report, timeline);
  if (late.count() > 0)
    out += ",\"late_us\":{\"p50\":" + in_us(late.quantile(0.5)) +
           ",\"p90\":" + in_us(late.quantile(0.9)) + ",\"p99\":" + in_us(late.quantile(0.99)) +
           ",\"max\":" + in_us(late.latest()) + "}";
  return out + ",\"seam_error_us\":" + in_us(report.seam_error) +
         ",\"aborted\":" + truth(report.aborted) + ",\"stopped\":" + truth(report.stopped) +
         ",\"memory_locked\":" + truth(realtime.memory_locked) +
         ",\"fifo\":" + truth(realtime.fifo) + "}\n";
}

}  // namespace pitwall::replay
