// Record of one run: an MCAP file with channels of flat structs at any rate (CDR) and events as
// text (JSON). Its SHA-256 identifies the run: same build, scenario and seed give the same digest.
//   in     metadata of the run and a sink; channels, until start(); then samples and events
//   out    bytes to the sink; a digest of all of them
//   errors as McapWriter: refused and counted, no exception
//   cost   as McapWriter; no allocation between start() and close()
//
//   EventLog log{{{"scenario", name}}, sink};
//   const auto ego = log.channel<EgoSample>("/vehicle/ego");
//   log.start();
//   log.sample(ego, now, EgoSample{...});          log.event(now, "flag", "green");
//   log.close();                                   to_hex(log.digest())
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/bits/sha256.hpp"
#include "protocol/recording/cdr_struct.hpp"
#include "protocol/recording/mcap_writer.hpp"

namespace pitwall::recording {

inline constexpr std::string_view kEventTopic = "/events";
// Longer names and texts are cut: an event is one line of text for people.
inline constexpr std::size_t kEventNameMax = 64, kEventTextMax = 1024;

template <class S>
struct SampleChannel {
  ChannelId id;
};

class EventLog {
 public:
  EventLog(Metadata run, Sink sink, McapLimits limits = {});
  EventLog(const EventLog&) = delete;  // the writer's sink points to the hash of this log
  EventLog& operator=(const EventLog&) = delete;

  // Call before start() only.
  template <class S>
  SampleChannel<S> channel(std::string topic) {
    return {add(cdr_channel<S>(std::move(topic)))};
  }
  ChannelId add(Channel channel);
  void start();

  // Call after start(). False: refused and counted.
  template <class S>
  bool sample(SampleChannel<S> channel, Instant at, const S& value) {
    std::array<std::uint8_t, cdr_bytes_max<S>()> buffer;
    return write(channel.id, at, to_cdr(value, std::span{buffer}));
  }
  // {"name":...,"text":...} on /events. Bytes outside of printable ASCII become '?'.
  bool event(Instant at, std::string_view name, std::string_view text);
  // Message in the declared encoding of the channel.
  bool write(ChannelId channel, Instant at, std::span<const std::uint8_t> data);
  bool flush();
  bool close();

  // Digest of all bytes that the sink has accepted so far.
  bits::Sha256::Digest digest() const;
  McapCounters counters() const;

 private:
  Metadata run_;
  Sink sink_;
  McapLimits limits_;
  std::vector<Channel> channels_;
  bits::Sha256 hash_;
  std::vector<std::uint8_t> event_;
  std::unique_ptr<McapWriter> writer_;
};

}  // namespace pitwall::recording
