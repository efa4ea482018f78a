// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/lcm_recording.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "hil/replay/recordings/receiver_stream.hpp"
#include "hil/replay/recordings/recording_builder.hpp"
#include "protocol/recording/lcm_log.hpp"
#include "protocol/telemetry/export/lcm_schema.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::traffic {
namespace {

// Numbers of an LCM message, the most significant byte first.
class LcmCursor {
 public:
  explicit LcmCursor(Bytes bytes) : rest_(bytes) {}

  std::uint64_t number(std::size_t bytes) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : take(bytes)) value = value << 8U | byte;
    return value;
  }
  Bytes take(std::size_t bytes) {
    ok_ = ok_ && bytes <= rest_.size();
    if (!ok_) return {};
    const Bytes taken = rest_.first(bytes);
    rest_ = rest_.subspan(bytes);
    return taken;
  }
  bool at_end() const { return ok_ && rest_.empty(); }

 private:
  Bytes rest_;
  bool ok_ = true;
};

constexpr std::size_t kFingerprintBytes = 8, kTimeBytes = 8, kNumberBytes = 4;

std::optional<can::Frame> can_of(Bytes message) {
  LcmCursor in{message};
  in.take(kFingerprintBytes + kTimeBytes);
  can::Frame frame;
  frame.id = static_cast<std::uint32_t>(in.number(kNumberBytes));
  for (bool* flag : {&frame.extended, &frame.remote, &frame.fd}) *flag = in.number(1) != 0;
  const std::uint64_t length = in.number(kNumberBytes);
  const Bytes data = in.take(length);
  const std::uint32_t most = frame.extended ? can::kMaxExtendedId : can::kMaxStandardId;
  if (!in.at_end() || length > can::kMaxDataBytes || frame.id > most) return std::nullopt;
  frame.length = static_cast<std::uint8_t>(length);
  std::ranges::copy(data, frame.data.begin());
  return frame;
}

std::optional<Bytes> stream_of(Bytes message) {
  LcmCursor in{message};
  in.take(kFingerprintBytes + kTimeBytes);
  const Bytes data = in.take(in.number(kNumberBytes));
  if (!in.at_end()) return std::nullopt;
  return data;
}

class LcmImport {
 public:
  LcmImport(const transport::FileBytes& file, const std::string& name,
            const replay::ReadProgress& reached)
      : builder_(name, reached, file.bytes().size()), file_(builder_.pool().adopt(file)) {}

  std::uint64_t read() {
    recording::LcmLogReader reader{file_};
    std::size_t expected = 0;
    while (const auto event = reader.next()) {
      const std::size_t begin = place_of(event->channel) - recording::kLcmHeadBytes;
      skip(expected, begin);
      take(*event, begin);
      expected = begin + recording::kLcmHeadBytes + event->channel.size() + event->data.size();
    }
    skip(expected, file_.size());
    return reader.events();
  }

  Recording finish() && {
    for (std::uint32_t i = 0; i < builder_.sources().size(); ++i) {
      Source& source = builder_.sources()[i];
      if (source.kind != SourceKind::kReceiver) continue;
      source.type = to_string(receiver_of(as_bytes(builder_.first_bytes(i, kReceiverProbeBytes))));
    }
    return std::move(builder_).finish();
  }

 private:
  std::size_t place_of(std::string_view text) const {
    return static_cast<std::size_t>(reinterpret_cast<const std::uint8_t*>(text.data()) -
                                    file_.data());
  }

  void skip(std::size_t from, std::size_t to) {
    if (from >= to) return;
    builder_.counters().lost_bytes += to - from;
    builder_.remark(from,
                    "bytes of no whole event: left out, " + std::to_string(to - from) + " bytes");
  }

  // One channel may carry several types, though none of ours does.
  std::uint32_t source_of(std::string_view channel, std::uint64_t fingerprint) {
    const auto [entry, is_new] = sources_.try_emplace({std::string{channel}, fingerprint});
    if (is_new) {
      const SourceKind kind = fingerprint == can_      ? SourceKind::kCan
                              : fingerprint == stream_ ? SourceKind::kReceiver
                                                       : SourceKind::kOther;
      entry->second = builder_.add_source(
          std::string{channel}, kind, kind == SourceKind::kCan ? "can" : "lcm " + hex(fingerprint));
    }
    return entry->second;
  }

  void take(const recording::LcmEvent& event, std::size_t begin) {
    const std::uint64_t fingerprint = LcmCursor{event.data}.number(kFingerprintBytes);
    const std::uint32_t source = source_of(event.channel, fingerprint);
    if (fingerprint == can_) {
      const auto frame = can_of(event.data);
      if (!frame) return builder_.refuse(begin, "CAN frame that cannot be read");
      builder_.add(source, event.at, *frame, begin);
    } else if (fingerprint == stream_) {
      const auto bytes = stream_of(event.data);
      if (!bytes) return builder_.refuse(begin, "bytes of a receiver that cannot be read");
      builder_.add(source, event.at, *bytes, begin);
    } else {
      builder_.add(source, event.at, event.data, begin);
    }
  }

  const std::uint64_t can_ = telemetry::lcm_fingerprint(telemetry::lcm_can_type());
  const std::uint64_t stream_ = telemetry::lcm_fingerprint(telemetry::lcm_bytes_type());
  RecordingBuilder builder_;
  Bytes file_;
  std::map<std::pair<std::string, std::uint64_t>, std::uint32_t> sources_;
};

}  // namespace

Result<Recording, Problem> read_lcm(const transport::FileBytes& file, const std::string& name,
                                    const replay::ReadProgress& reached) {
  LcmImport import{file, name, reached};
  if (import.read() == 0) return refuse(name + ": byte 0", "holds no event of LCM");
  return std::move(import).finish();
}

}  // namespace pitwall::traffic
