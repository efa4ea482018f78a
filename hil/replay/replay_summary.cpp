// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_summary.hpp"

#include "hil/replay/replay_clock.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::replay {
namespace {

std::string count(std::uint64_t n) { return std::to_string(n); }
std::int64_t whole_us(Duration d) { return d.ns / 1'000; }
std::string in_us(Duration d) { return std::to_string(whole_us(d)); }

std::string content_of(const Track& track, std::size_t record) {
  if (track.to) return " " + count(track.datagrams[record].size()) + " bytes";
  const can::Frame& frame = track.frames[record];
  const int digits = frame.extended ? 8 : 3;
  return formatted(" %0*X", digits, frame.id);
}

// "can0 1A0 due at 1.234567 s", "127.0.0.1:3001 104 bytes due at ..."
std::string name_of(const DroppedRecord& dropped, const Timeline& timeline) {
  const Track& track = timeline.tracks[dropped.track];
  return track.target + content_of(track, dropped.record) + " due at " +
         std::to_string(track.due[dropped.record].seconds()) + " s of pass " +
         count(dropped.pass + 1ULL);
}

std::string drops_text(const PlayCount& of, const char* what) {
  if (of.dropped() == 0) return {};
  return "dropped " + count(of.dropped()) + " " + what + ": " + count(of.dropped_late) +
         " too late, " + count(of.dropped_full) + " queue full, " + count(of.dropped_refused) +
         " refused\n";
}

std::string drops_text(const PlayReport& report, const Timeline& timeline) {
  if (report.dropped() == 0) return {};
  std::string out = drops_text(report.frames, "frames") + drops_text(report.datagrams, "datagrams");
  for (const DroppedRecord& dropped : report.dropped_list)
    out += "  " + name_of(dropped, timeline) + ", late by " + in_us(dropped.late) + " us\n";
  if (report.dropped() > report.dropped_list.size()) out += "  and more\n";
  return out;
}

std::string drops_json(const PlayReport& report, const Timeline& timeline) {
  json::Array out;
  for (const DroppedRecord& dropped : report.dropped_list) {
    const Track& track = timeline.tracks[dropped.track];
    json::Object one;
    one.number("pass", dropped.pass + 1ULL).text("to", track.target);
    if (track.to) {
      one.number("bytes", track.datagrams[dropped.record].size());
    } else {
      one.number("id", track.frames[dropped.record].id);
    }
    out.json(one.number("due_us", whole_us(track.due[dropped.record]))
                 .number("late_us", whole_us(dropped.late))
                 .str());
  }
  return out.str();
}

std::string left_out_text(const Timeline& timeline) {
  std::string text;
  std::uint64_t records = 0;
  for (const LeftOut& left : timeline.left_out) records += left.records;
  if (records > 0)
    text += "not played: " + count(records) + " records of " + count(timeline.left_out.size()) +
            " sources\n";
  if (timeline.filtered > 0)
    text +=
        "not played: " + count(timeline.filtered) + " frames of a pass, by identifier or node\n";
  return text;
}

std::string restamp_text(const Timeline& timeline) {
  if (timeline.restamped == 0) return {};
  std::string text = "restamped: " + count(timeline.restamped) + " frames of a pass";
  if (timeline.unfit > 0)
    text += "; as they were, because of another length: " + count(timeline.unfit);
  return text + "\n";
}

std::string left_out_json(const Timeline& timeline) {
  json::Array out;
  for (const LeftOut& left : timeline.left_out)
    out.json(json::Object{}
                 .text("source", left.source)
                 .text("why", left.why)
                 .number("records", left.records)
                 .str());
  return out.str();
}

std::string streams_json(std::span<const StreamReport> streams) {
  json::Array out;
  for (const auto& [target, c] : streams)
    out.json(json::Object{}
                 .text("to", target)
                 .number("opened", c.opened)
                 .number("ended", c.ended)
                 .number("sent_bytes", c.sent_bytes)
                 .number("dropped_absent", c.dropped_absent)
                 .number("dropped_full", c.dropped_full)
                 .number("lost_bytes", c.lost_bytes)
                 .number("ignored_bytes", c.ignored_bytes)
                 .str());
  return out.str();
}

void add(json::Object& out, const PlayCount& of) {
  out.number("sent", of.sent)
      .number("dropped_late", of.dropped_late)
      .number("dropped_full", of.dropped_full)
      .number("dropped_refused", of.dropped_refused);
}

}  // namespace

std::string to_text(const PlayReport& report, const Timeline& timeline) {
  const LatenessHistogram& late = report.lateness;
  const std::string datagrams =
      timeline.datagrams == 0 ? "" : " and " + count(report.datagrams.sent) + " datagrams";
  std::string out = "sent " + count(report.frames.sent) + " frames" + datagrams + " in " +
                    std::to_string(report.took.seconds()) + " s (" + count(report.calls) +
                    " calls, " + count(report.waits) + " sleeps, " + count(report.retries) +
                    " retries, " + count(report.dropped()) + " dropped)\n";
  if (late.count() > 0)
    out += "lateness p50 " + in_us(late.quantile(0.5)) + " us, p90 " + in_us(late.quantile(0.9)) +
           " us, p99 " + in_us(late.quantile(0.99)) + " us, max " + in_us(late.latest()) + " us\n";
  if (report.seam_error.ns > 0)
    out += "gaps between passes wrong by " + in_us(report.seam_error) + " us at most\n";
  out += drops_text(report, timeline);
  out += left_out_text(timeline);
  out += restamp_text(timeline);
  if (report.aborted) out += "aborted: a frame or datagram was later than allowed\n";
  if (report.stopped) out += "stopped by a signal\n";
  return out;
}

std::string to_text(std::span<const StreamReport> streams) {
  std::string out;
  for (const StreamReport& stream : streams) {
    const transport::StreamSenderCounters& c = stream.counters;
    out += stream.target + ": opened " + count(c.opened) + " times, " + count(c.sent_bytes) +
           " bytes sent; dropped " + count(c.dropped_absent) + " records without a reader, " +
           count(c.dropped_full) + " while it did not read";
    if (c.lost_bytes > 0) out += "; " + count(c.lost_bytes) + " bytes lost when it ended";
    if (c.ignored_bytes > 0) out += "; " + count(c.ignored_bytes) + " bytes of its own ignored";
    out += "\n";
  }
  return out;
}

std::string to_json(const PlayReport& report, const Timeline& timeline,
                    std::span<const StreamReport> streams,
                    const transport::RealtimeReport& realtime,
                    const std::optional<transport::ClockWaits>& waits) {
  const LatenessHistogram& late = report.lateness;
  json::Object datagrams;
  add(datagrams.number("per_pass", timeline.datagrams), report.datagrams);
  json::Object out;
  out.text("verb", "replay").number("frames_per_pass", timeline.frames);
  add(out, report.frames);
  out.json("datagrams", datagrams.str())
      .json("streams", streams_json(streams))
      .json("left_out", left_out_json(timeline))
      .number("filtered_per_pass", timeline.filtered)
      .number("restamped_per_pass", timeline.restamped)
      .number("not_restamped_per_pass", timeline.unfit)
      .number("took_us", whole_us(report.took))
      .number("calls", report.calls)
      .number("sleeps", report.waits)
      .number("retries", report.retries)
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
             .json("bench_time", waits ? to_json(*waits) : "null")
             .str() +
         "\n";
}

}  // namespace pitwall::replay
