// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/receiver_port.hpp"

#include <array>

#include "protocol/json/json_text.hpp"
#include "protocol/transport/stream/serial_port.hpp"

namespace pitwall::io {
namespace {

// What waits after a stall of the process is read within a few ticks; a flood is not read at once.
constexpr std::size_t kBatchesPerRead = 4;
constexpr std::size_t kBytesPerRead = 4'096;

constexpr std::array<const char*, receivers::kStreams> kStreamNames{"positions", "velocities",
                                                                    "headings", "imu", "attitudes"};

std::uint64_t lost_by(const transport::UdpSocket& socket) {
  return socket.counters().rx_dropped_queue + socket.counters().rx_truncated;
}

std::uint64_t lost_by(const transport::StreamLink& stream) {
  return stream.counters().ended + stream.counters().silent;
}

void add_source(json::Object& out, const transport::UdpSocket& socket) {
  out.number("datagrams", socket.counters().received);
  out.number("rx_dropped", lost_by(socket));
}

void add_source(json::Object& out, const transport::StreamLink& stream) {
  const transport::StreamCounters& c = stream.counters();
  out.number("opened", c.opened);
  out.number("attempts_failed", c.refused);
  out.number("ended", c.ended);
  out.number("silent", c.silent);
}

}  // namespace

Result<ReceiverPort, Problem> ReceiverPort::open(const ReceiverLink& link, std::uint8_t unit,
                                                 const world::ReceiverParams& params) {
  if (const auto* udp = std::get_if<UdpReceiver>(&link)) {
    auto socket = transport::UdpSocket::bind(udp->local);
    if (!socket) return Unexpected{socket.error()};
    return ReceiverPort{link, *std::move(socket), unit, params};
  }
  if (const auto* tcp = std::get_if<transport::TcpAddress>(&link))
    return ReceiverPort{link, transport::StreamLink{*tcp}, unit, params};
  // One that cannot be opened at the start is a mistake of whoever wrote it.
  const auto& device = std::get<transport::SerialDevice>(link);
  if (const auto tried = transport::open_serial(device.path, device.baud); !tried)
    return Unexpected{tried.error()};
  return ReceiverPort{link, transport::StreamLink{device}, unit, params};
}

void ReceiverPort::read(world::SensorInput& out, Instant now, const Observer& reported) {
  std::visit([&](auto& source) { read(source, out, now, reported); }, source_);
}

void ReceiverPort::read(transport::UdpSocket& socket, world::SensorInput& out, Instant now,
                        const Observer& reported) {
  std::array<transport::UdpDatagram, transport::UdpSocket::kBatch> datagrams;
  for (std::size_t batch = 0; batch < kBatchesPerRead; ++batch) {
    const std::size_t count = socket.receive(datagrams);
    for (const transport::UdpDatagram& datagram : std::span(datagrams).first(count)) {
      if (reported) reported(datagram.at, datagram.payload());
      receiver_.feed(datagram.payload(), datagram.at, out);
    }
    if (count > 0) byte_at_ = now;
    if (count < datagrams.size()) return;
  }
}

void ReceiverPort::read(transport::StreamLink& stream, world::SensorInput& out, Instant now,
                        const Observer& reported) {
  std::array<std::uint8_t, kBytesPerRead> buffer;
  for (std::size_t batch = 0; batch < kBatchesPerRead; ++batch) {
    const auto bytes = stream.read(buffer, now);
    if (reported && !bytes.empty()) reported(now, bytes);
    receiver_.feed(bytes, now, out);
    if (!bytes.empty()) byte_at_ = now;
    if (bytes.size() < buffer.size()) return;
  }
}

world::ReceiverTraffic ReceiverPort::traffic() const {
  world::ReceiverTraffic traffic = receivers::traffic_of(receiver_.counters());
  traffic.lost = std::visit([](const auto& source) { return lost_by(source); }, source_);
  return traffic;
}

std::string ReceiverPort::json() const {
  const receivers::Counters c = receiver_.counters();
  json::Object out;
  out.text("link", to_string(link_));
  out.text("kind", std::string(world::name_of(kind_)));
  std::visit([&](const auto& source) { add_source(out, source); }, source_);
  out.number("bytes", c.bytes);
  out.number("frames", c.frames);
  out.number("garbage_bytes", c.garbage_bytes);
  out.number("resyncs", c.resyncs);
  out.number("bad_checksum", c.bad_checksum);
  out.number("bad_frame", c.bad_frame);
  out.number("unused", c.unused);
  out.number("time_unknown", c.time_unknown);
  out.number("out_of_range", c.out_of_range);
  out.number("imu_error", c.imu_error);
  for (std::size_t i = 0; i < receivers::kStreams; ++i) out.number(kStreamNames[i], c.samples[i]);
  out.number("health", c.health);
  using receivers::StampFlaw;
  out.number("stamps_frozen", c.stamps[static_cast<std::size_t>(StampFlaw::kFrozen)]);
  out.number("stamps_back", c.stamps[static_cast<std::size_t>(StampFlaw::kBack)]);
  out.number("stamps_future", c.stamps[static_cast<std::size_t>(StampFlaw::kFuture)]);
  out.number("clock_steps", c.clock_steps);
  json::Object refused;
  for (std::size_t i = 0; i < c.refused.counts.size(); ++i)
    refused.number(std::string(gnss::kDecodeErrorText[i]), c.refused.counts[i]);
  out.json("refused", refused.str());
  return out.str();
}

Result<std::vector<ReceiverPort>, Problem> open_receivers(const ReceiverLinks& links,
                                                          const world::Receivers& params) {
  std::vector<ReceiverPort> ports;
  for (std::size_t unit = 0; unit < links.size(); ++unit) {
    auto port = ReceiverPort::open(links[unit], static_cast<std::uint8_t>(unit), params[unit]);
    if (!port) return Unexpected{port.error()};
    ports.push_back(*std::move(port));
  }
  return ports;
}

std::string receivers_json(std::span<const ReceiverPort> ports) {
  std::string list;
  for (const ReceiverPort& port : ports) list += (list.empty() ? "\n  " : ",\n  ") + port.json();
  return "[" + list + "]";
}

}  // namespace pitwall::io
