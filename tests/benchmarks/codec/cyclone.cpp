// SPDX-License-Identifier: Apache-2.0
#include <dds/dds.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vehicle_state_codec.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {
namespace {

// RTPS 2.x, 8.3: header, then submessages of id, flags, length and content.
constexpr std::size_t kRtpsHeader = 20, kSubmessageHeader = 4, kDataFixed = 20;
constexpr std::uint8_t kDataId = 0x15;
constexpr std::size_t kSmallest = 300;  // discovery and heartbeats are shorter

struct Seen {
  std::atomic<std::size_t> datagrams = 0, bytes = 0, payload = 0;
};
Seen& seen() {
  static Seen value;
  return value;
}

// The serialised sample in an RTPS datagram; 0: there is none.
std::size_t sample_size(Bytes datagram) {
  std::size_t at = kRtpsHeader;
  while (at + kSubmessageHeader <= datagram.size()) {
    const std::size_t length = datagram[at + 2] | static_cast<std::size_t>(datagram[at + 3]) << 8U;
    if (datagram[at] == kDataId && length > kDataFixed) return length - kDataFixed;
    at += kSubmessageHeader + length;
  }
  return 0;
}

void note(const msghdr& message) {
  std::array<std::uint8_t, 2'048> datagram{};
  std::size_t size = 0;
  for (std::size_t i = 0; i < message.msg_iovlen; ++i) {
    const iovec& part = message.msg_iov[i];
    if (part.iov_len > datagram.size() - size) return;
    std::memcpy(datagram.data() + size, part.iov_base, part.iov_len);
    size += part.iov_len;
  }
  if (size < kSmallest || std::memcmp(datagram.data(), "RTPS", 4) != 0) return;
  const std::size_t sample = sample_size({datagram.data(), size});
  if (sample < kSmallest) return;
  ++seen().datagrams;
  seen().bytes += size;
  seen().payload += sample;
}

}  // namespace
}  // namespace pitwall::codec

// In front of libc's: what Cyclone DDS hands to the kernel, byte for byte.
extern "C" ssize_t sendmsg(int descriptor, const msghdr* message, int flags) {
  pitwall::codec::note(*message);
  return syscall(SYS_sendmsg, descriptor, message, flags);
}

namespace pitwall::codec {
namespace {

constexpr const char* kLoopbackOnly =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto"
    "</ParticipantIndex><Peers><Peer Address=\"127.0.0.1\"/></Peers></Discovery></Domain>"
    "</CycloneDDS>";
constexpr dds_domainid_t kDomain = 77;
constexpr int kSamples = 20, kMatchTries = 150;
constexpr dds_duration_t kTry = DDS_MSECS(100), kPause = DDS_MSECS(10);

struct Topic {
  dds_entity_t participant = dds_create_participant(kDomain, nullptr, nullptr);
  dds_entity_t topic =
      dds_create_topic(participant, &codec_schema_State_desc, "state", nullptr, nullptr);
};

// As state is sent: no acknowledgements, hence no heartbeats beside the samples.
dds_qos_t* best_effort() {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  return qos;
}

[[noreturn]] void read_for_ever() {
  const Topic topic;
  const dds_entity_t reader =
      dds_create_reader(topic.participant, topic.topic, best_effort(), nullptr);
  if (reader < 0) _exit(1);
  while (true) dds_sleepfor(DDS_SECS(1));
}

codec_schema_State sample_of(const Values& v) {
  codec_schema_State sample{};
  for (std::size_t i = 0; i < kReals.size(); ++i) sample.floats[i] = real_of(v, i);
  for (std::size_t i = 0; i < kIntegers.size(); ++i) sample.integers[i] = integer_of(v, i);
  for (std::size_t i = 0; i < kYesNos.size(); ++i) sample.flags[i] = yes_no_of(v, i);
  return sample;
}

void write_samples(const std::vector<Values>& trace) {
  const Topic topic;
  const dds_entity_t writer =
      dds_create_writer(topic.participant, topic.topic, best_effort(), nullptr);
  dds_publication_matched_status_t matched{};
  for (int i = 0; i < kMatchTries && matched.current_count == 0; ++i) {
    dds_sleepfor(kTry);
    dds_get_publication_matched_status(writer, &matched);
  }
  for (int i = 0; matched.current_count > 0 && i < kSamples; ++i) {
    const auto sample = sample_of(trace[static_cast<std::size_t>(i) * trace.size() / kSamples]);
    dds_write(writer, &sample);
    dds_sleepfor(kPause);
  }
  dds_delete(topic.participant);
}

}  // namespace

std::optional<Measured> cyclone(const std::vector<Values>& trace) {
  setenv("CYCLONEDDS_URI", kLoopbackOnly, 1);
  const pid_t reader = fork();
  if (reader < 0) return std::nullopt;
  if (reader == 0) read_for_ever();
  write_samples(trace);
  kill(reader, SIGKILL);
  waitpid(reader, nullptr, 0);
  const auto count = static_cast<double>(seen().datagrams);
  if (count == 0.0) return std::nullopt;
  return Measured{.name = "Cyclone DDS, float",
                  .bytes_by = "idlc, libddsc (as sent on loopback)",
                  .payload = static_cast<double>(seen().payload) / count,
                  .datagram = static_cast<double>(seen().bytes) / count,
                  .authenticated = false,
                  .encode_ns = {},
                  .decode_ns = {}};
}

}  // namespace pitwall::codec
