// The way of a published team: protobuf messages with a length in front, each in a UDP datagram of
// its own; state, perception and trajectory back to back every 50 ms, without pace. Unlike that
// team's base, which looks at its socket every 50 ms, this one reads at once. MODE "paced": bulk in
// pieces.
// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/delimited_message_util.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <cstring>
#include <string>
#include <vector>

#include <vehicle_state.pb.h>
#include "tests/benchmarks/protocol_comparison/peers/peer.hpp"

namespace pitwall::peers {
namespace {

constexpr const char* kBaseAddress = "10.77.0.2";
constexpr std::uint16_t kPort = 24'000;
constexpr Duration kPeriod = milliseconds(50);
constexpr int kDetections = 5, kPolylines = 3, kPoints = 16;

sockaddr_in address_of(std::uint32_t ip) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_addr.s_addr = ip;
  out.sin_port = htons(kPort);
  return out;
}

int open_socket() {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  if (fd < 0) std::abort();
  return fd;
}

void send_message(int fd, const comparison::UdpMessage& message) {
  std::string bytes;
  google::protobuf::io::StringOutputStream stream(&bytes);
  google::protobuf::util::SerializeDelimitedToZeroCopyStream(message, &stream);
  const std::size_t size = static_cast<std::size_t>(stream.ByteCount());
  const sockaddr_in to = address_of(inet_addr(kBaseAddress));
  static_cast<void>(
      sendto(fd, bytes.data(), size, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to));
}

// Field by field, as generated code of a hundred fields is filled.
comparison::UdpMessage state_message(const VehicleState& state) {
  comparison::UdpMessage message;
  comparison::VehicleData* data = message.mutable_vehicle();
  data->set_made_ns(static_cast<std::uint64_t>(state.made_ns));
  const auto* fields = comparison::VehicleData::descriptor();
  const auto* set = comparison::VehicleData::GetReflection();
  int next = 1;
  for (const float value : state.floats) set->SetFloat(data, fields->field(next++), value);
  for (const std::int32_t value : state.integers) set->SetInt32(data, fields->field(next++), value);
  for (const bool value : state.flags) set->SetBool(data, fields->field(next++), value);
  return message;
}

comparison::UdpMessage perception_message(const VehicleState& state) {
  comparison::UdpMessage message;
  for (int i = 0; i < kDetections; ++i) {
    comparison::Detection* detection = message.mutable_perception()->add_detections();
    detection->set_id(static_cast<std::uint32_t>(i + 1));
    detection->set_x(state.floats[static_cast<std::size_t>(i)]);
    detection->set_y(state.floats[static_cast<std::size_t>(i + 10)]);
    detection->set_yaw(state.floats[static_cast<std::size_t>(i + 20)]);
    detection->set_speed(state.floats[static_cast<std::size_t>(i + 30)]);
  }
  return message;
}

comparison::UdpMessage trajectory_message(const VehicleState& state) {
  comparison::UdpMessage message;
  for (int line = 0; line < kPolylines; ++line) {
    comparison::Polyline* polyline = message.mutable_trajectory()->add_polylines();
    for (int point = 0; point < kPoints; ++point) {
      polyline->add_x(state.floats[static_cast<std::size_t>(point)]);
      polyline->add_y(state.floats[static_cast<std::size_t>(point + 20 * line)]);
    }
  }
  return message;
}

std::size_t wire_bytes(const comparison::UdpMessage& message) {
  constexpr std::size_t kAround = 2 + 28;  // length in front, IP and UDP
  return message.ByteSizeLong() + kAround;
}

BulkPlan bulk_plan(const Call& call) {
  if (call.mode != "paced") return {};
  const VehicleState state = state_at(transport::monotonic_now());
  const std::size_t bytes = wire_bytes(state_message(state)) +
                            wire_bytes(perception_message(state)) +
                            wire_bytes(trajectory_message(state));
  comparison::UdpMessage empty;
  empty.set_bulk(std::string(1, 'b'));
  return paced(kPeriod, bytes, wire_bytes(empty));
}

void drive(const Call& call) {
  const int fd = open_socket();
  const BulkPlan plan = bulk_plan(call);
  comparison::UdpMessage bulk;
  bulk.set_bulk(std::string(plan.bytes, 'b'));
  send_until_end(
      call, kPeriod, plan,
      [fd](Instant now) {
        const VehicleState state = state_at(now);
        send_message(fd, state_message(state));
        send_message(fd, perception_message(state));
        send_message(fd, trajectory_message(state));
      },
      [&](Instant) { send_message(fd, bulk); });
}

void listen(const Call& call) {
  const int fd = open_socket();
  const sockaddr_in here = address_of(INADDR_ANY);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0) std::abort();
  const timeval patience{.tv_sec = 0, .tv_usec = 50'000};
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  std::vector<std::uint8_t> buffer(65'536);
  while (transport::monotonic_now() < call.end) {
    const ssize_t got = recv(fd, buffer.data(), buffer.size(), 0);
    if (got <= 0) continue;
    google::protobuf::io::ArrayInputStream stream(buffer.data(), static_cast<int>(got));
    comparison::UdpMessage message;
    bool clean_end = false;
    if (!google::protobuf::util::ParseDelimitedFromZeroCopyStream(&message, &stream, &clean_end))
      continue;
    if (message.what_case() == comparison::UdpMessage::kBulk) note_bulk(message.bulk().size());
    if (message.has_vehicle()) note_arrival(static_cast<std::int64_t>(message.vehicle().made_ns()));
  }
}

}  // namespace
}  // namespace pitwall::peers

int main(int argc, char** argv) {
  const auto call = pitwall::peers::call_of(argc, argv);
  call.car ? pitwall::peers::drive(call) : pitwall::peers::listen(call);
  return 0;
}
