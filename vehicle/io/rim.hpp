// Everything of the car process that touches the outside: CAN socket, receivers' UDP ports, radio.
// read() before the step, write() after it.
//   in     Arguments
//   out    what arrived since the last read; counters
//   errors open(): Problem that names the interface or the port; afterwards counters only
//   cost   no allocation after open()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/can_socket.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/io/arguments.hpp"
#include "vehicle/io/gnss_input.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::io {

class Rim {
 public:
  static Result<Rim, Problem> open(const Arguments& args);

  struct Heard {
    std::span<const can::ReceivedFrame> can;  // valid until the next read()
    world::SensorInput sensors;
    std::array<std::optional<Instant>, world::kGnssUnits> gnss_byte_at;  // newest, if any
  };
  Heard read();
  void write(std::span<const can::Frame> frames);
  // Completes the packet (sequence, run, source, time of sending) and sends it.
  void report(telemetry::StatePacket& packet, Instant now);

  const transport::CanSocketCounters& can() const { return can_.counters(); }
  // Frames that the kernel did not take: a command is never sent late, so they are dropped.
  std::uint64_t tx_drops() const { return tx_drops_; }
  void poll_drops() { can_.poll_drops(); }

 private:
  Rim(transport::CanSocket can, std::vector<transport::UdpSocket> gnss, transport::UdpSocket radio,
      transport::UdpAddress base, bool simulation);

  transport::CanSocket can_;
  std::vector<transport::UdpSocket> gnss_;
  std::array<GnssInput, world::kGnssUnits> receivers_;
  transport::UdpSocket radio_;
  transport::UdpAddress base_;
  std::vector<can::ReceivedFrame> frames_;
  std::array<std::optional<Instant>, world::kGnssUnits> gnss_byte_at_{};
  telemetry::Source source_;
  std::uint32_t run_ = 0, sequence_ = 0;
  telemetry::EncodeCounters encoded_;
  std::uint64_t tx_drops_ = 0;
};

}  // namespace pitwall::io
