// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/receiver_stream.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "hil/replay/recordings/recording_builder.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "protocol/gnss/vectornav_stream.hpp"

namespace pitwall::traffic {
namespace {

constexpr Duration kGpsMinusUtc = seconds(18);
constexpr UtcTime kGpsEpoch{315'964'800 * kNanosecondsPerSecond};  // 1980-01-06
constexpr UtcTime kSince{1'483'228'800 * kNanosecondsPerSecond};   // 2017-01-01
constexpr std::int64_t kLatestGps_ns = kLatestStamp.ns - kGpsEpoch.ns;
constexpr Duration kStepBack = seconds(1);  // more is no late solution, but another time

// A message of a stream: its bytes in the file, and what it says of its time.
struct Span {
  std::size_t begin = 0, end = 0;
  std::optional<gnss::GpsTime> gps;
  std::optional<Duration> since_start;
};

std::optional<gnss::GpsTime> gps_of(const gnss::NovatelFrame& frame) {
  if (!gnss::has_time(frame.header)) return std::nullopt;
  return gnss::time_of(frame.header);
}

std::optional<gnss::GpsTime> gps_of(const gnss::VectorNavMessage& m) {
  using namespace gnss::vectornav;
  constexpr std::uint8_t kValid = kTowValid | kDateValid;
  if (m.output.has(kTimeStatus) && (m.time_status & kValid) != kValid) return std::nullopt;
  std::uint64_t ns = m.time_gps_ns;
  const bool in_week = m.tow_ns < static_cast<std::uint64_t>(gnss::kWeek_ms) * 1'000'000;
  if (ns == 0 && in_week && gnss::is_week(m.week)) {
    ns = m.tow_ns + static_cast<std::uint64_t>(gnss::gps_time(m.week, {}).ns);
  }
  if (ns == 0 || ns > static_cast<std::uint64_t>(kLatestGps_ns)) return std::nullopt;
  return gnss::GpsTime{static_cast<std::int64_t>(ns)};
}

Span span_of(const gnss::NovatelFrame& frame) {
  Span span;
  span.gps = gps_of(frame);
  return span;
}

Span span_of(const gnss::VectorNavFrame& frame) {
  const auto message = gnss::decode(frame);
  if (!message) return {};
  Span span;
  span.gps = gps_of(*message);
  const std::uint64_t ns = message->time_startup_ns;
  if (ns != 0 && ns <= static_cast<std::uint64_t>(kLatestStamp.ns))
    span.since_start = Duration{static_cast<std::int64_t>(ns)};
  return span;
}

// Every whole message. Zeros behind the end make the stream decide what it still holds back.
template <class Stream, std::size_t kLongest>
std::vector<Span> spans_of(Bytes file) {
  std::vector<Span> spans;
  Stream stream;
  std::size_t in_messages = 0;
  const auto sink = [&](const auto& frame) {
    Span span = span_of(frame);
    span.begin = static_cast<std::size_t>(stream.counters().garbage_bytes) + in_messages;
    span.end = span.begin + frame.bytes;
    in_messages += frame.bytes;
    if (span.end <= file.size()) spans.push_back(span);
  };
  stream.feed(file, sink);
  stream.feed(std::array<std::uint8_t, kLongest>{}, sink);
  return spans;
}

std::vector<Span> novatel_spans(Bytes file) {
  return spans_of<gnss::NovatelStream, gnss::NovatelStream::kMaxFrameBytes>(file);
}
std::vector<Span> vectornav_spans(Bytes file) {
  return spans_of<gnss::VectorNavStream, gnss::kMaxVectorNavBytes>(file);
}

std::size_t bytes_in(const std::vector<Span>& spans) {
  std::size_t bytes = 0;
  for (const Span& span : spans) bytes += span.end - span.begin;
  return bytes;
}

UtcTime to_utc(gnss::GpsTime t) { return {kGpsEpoch.ns + t.ns - kGpsMinusUtc.ns}; }

// Stamps of the messages: GPS time where any of them knows it.
class StreamClock {
 public:
  StreamClock(const std::vector<Span>& spans, RecordingBuilder& builder)
      : builder_(builder),
        by_gps_(std::ranges::any_of(spans, [](const Span& s) { return s.gps.has_value(); })) {
    const auto first =
        std::ranges::find_if(spans, [&](const Span& s) { return own_time(s).has_value(); });
    if (first == spans.end()) return;
    knows_ = true;
    at_ = *own_time(*first);
    if (!by_gps_) {
      builder_.remark(first->begin,
                      "no message knows GPS time: stamps count from the receiver's "
                      "start");
    } else if (at_ < kSince) {
      builder_.remark(first->begin, "recorded before 2017: stamps are up to 18 s too early");
    }
  }

  bool knows() const { return knows_; }

  UtcTime stamp(const Span& span) {
    const auto own = own_time(span);
    if (!own) {
      builder_.remark(span.begin, "message without a time: due with the one before");
    } else if (*own < UtcTime{at_.ns - kStepBack.ns}) {
      builder_.remark(span.begin, "time steps back by more than 1 s: due with the message before");
    }
    if (own) at_ = std::max(at_, *own);
    return at_;
  }

 private:
  std::optional<UtcTime> own_time(const Span& span) const {
    if (by_gps_) return span.gps ? std::optional{to_utc(*span.gps)} : std::nullopt;
    return span.since_start ? std::optional{UtcTime{span.since_start->ns}} : std::nullopt;
  }

  RecordingBuilder& builder_;
  bool by_gps_ = false, knows_ = false;
  UtcTime at_{};
};

}  // namespace

std::string_view to_string(Receiver receiver) {
  switch (receiver) {
    case Receiver::kNovatel:
      return "novatel";
    case Receiver::kVectorNav:
      return "vectornav";
    case Receiver::kUnknown:
      break;
  }
  return "unknown receiver";
}

Receiver receiver_of(Bytes bytes) {
  const Bytes probe = bytes.first(std::min(bytes.size(), kReceiverProbeBytes));
  const std::size_t novatel = bytes_in(novatel_spans(probe));
  const std::size_t vectornav = bytes_in(vectornav_spans(probe));
  if (novatel == 0 && vectornav == 0) return Receiver::kUnknown;
  return novatel >= vectornav ? Receiver::kNovatel : Receiver::kVectorNav;
}

Result<Recording, Problem> read_receiver_stream(const transport::FileBytes& file,
                                                const std::string& name) {
  RecordingBuilder builder{name};
  const Bytes bytes = builder.pool().adopt(file);
  const Receiver receiver = receiver_of(bytes);
  if (receiver == Receiver::kUnknown)
    return refuse(name + ": byte 0", "holds no message of a NovAtel or VectorNav receiver");
  const std::vector<Span> spans =
      receiver == Receiver::kNovatel ? novatel_spans(bytes) : vectornav_spans(bytes);
  StreamClock clock{spans, builder};
  if (!clock.knows())
    return refuse(name + ": byte 0",
                  "holds no message with a time, so it is not known when to send them");
  const auto source =
      builder.add_source("receiver", SourceKind::kReceiver, std::string{to_string(receiver)});
  std::size_t at = 0;
  for (const Span& span : spans) {
    if (span.begin > at)
      builder.remark(at, "bytes of no message: passed on with the message behind them");
    builder.add(source, clock.stamp(span), bytes.subspan(at, span.end - at), span.begin);
    at = span.end;
  }
  if (at < bytes.size()) {
    builder.counters().lost_bytes += bytes.size() - at;
    builder.remark(at, "cut message or bytes of none at the end: left out, " +
                           std::to_string(bytes.size() - at) + " bytes");
  }
  return std::move(builder).finish();
}

}  // namespace pitwall::traffic
