// Input port for the bytes of one receiver, over UDP, TCP or a serial line.
//   in     the link, the kind of receiver; the time
//   out    samples of all waiting bytes; the arrival time of the newest byte
//   invariants
//          a datagram has the kernel's receive time. Bytes of a stream have the time of the read,
//          so the clock of the receiver has to be learned from the fastest messages
//   errors open(): Problem with the link: a port that is in use, a missing device. A stream that
//          ends later is opened again and counted
//   cost   never waits, no heap allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/transport/stream/stream_link.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "vehicle/io/arguments/receiver_link.hpp"
#include "vehicle/receivers/receiver.hpp"
#include "vehicle/world/receiver.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::io {

class ReceiverPort {
 public:
  static Result<ReceiverPort, Problem> open(const ReceiverLink& link, std::uint8_t unit,
                                            const world::ReceiverParams& params);

  // `reported` gets every byte as it was read, before it is decoded.
  using Observer = std::function<void(Instant at, std::span<const std::uint8_t> bytes)>;
  void read(world::SensorInput& out, Instant now, const Observer& reported = {});

  std::optional<Instant> byte_at() const { return byte_at_; }
  receivers::Counters counters() const { return receiver_.counters(); }
  world::ReceiverTraffic traffic() const;
  // One JSON object: the link, its counters and those of its bytes.
  std::string json() const;

 private:
  using Source = std::variant<transport::UdpSocket, transport::StreamLink>;

  ReceiverPort(const ReceiverLink& link, Source source, std::uint8_t unit,
               const world::ReceiverParams& params)
      : link_(link), kind_(params.kind), source_(std::move(source)), receiver_(unit, params) {}
  void read(transport::UdpSocket& socket, world::SensorInput& out, Instant now,
            const Observer& reported);
  void read(transport::StreamLink& stream, world::SensorInput& out, Instant now,
            const Observer& reported);

  ReceiverLink link_;
  world::ReceiverKind kind_;
  Source source_;
  receivers::Receiver receiver_;
  std::optional<Instant> byte_at_;
};

// Ports of all units, with the kinds of receiver that the car file names.
Result<std::vector<ReceiverPort>, Problem> open_receivers(const ReceiverLinks& links,
                                                          const world::Receivers& params);

std::string receivers_json(std::span<const ReceiverPort> ports);

}  // namespace pitwall::io
