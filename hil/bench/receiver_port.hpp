// The bench speaking as the car's two NovAtel receivers: samples to OEM7 binary, one UDP port each,
// for the car and for whoever else has receivers of the same kind (the guardian).
//   in     samples of hil/sensors, `at` in scenario time
//   out    datagrams to 127.0.0.1:port and port + 1 of every listener
//   frames IMU: Body (x forward, y left, z up) to NovAtel's vehicle frame (x right, y forward, z
//          up)
//   errors open(): Problem; a datagram that was not taken is counted by the socket
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::bench {

// GPS time of scenario time zero; any week will do, and this one is not zero, which means
// "unknown".
inline constexpr std::uint16_t kScenarioGpsWeek = 2'190;

struct NovatelDatagram {
  std::array<std::uint8_t, gnss::kMaxEncodedBytes> data{};
  std::size_t length = 0;
};

NovatelDatagram to_novatel(const world::GnssPosition& sample);
NovatelDatagram to_novatel(const world::GnssVelocity& sample);
NovatelDatagram to_novatel(const world::GnssHeading& sample);
NovatelDatagram to_novatel(const world::ImuSample& sample);

class ReceiverPort {
 public:
  // One port per listener: where unit 0 of that listener is heard.
  static Result<ReceiverPort, Problem> open(std::vector<std::uint16_t> first_ports);

  void send(const world::SensorInput& samples);
  const transport::UdpCounters& counters() const { return socket_.counters(); }

 private:
  ReceiverPort(transport::UdpSocket socket, std::vector<std::uint16_t> first_ports)
      : socket_(std::move(socket)), first_ports_(std::move(first_ports)) {}
  void send_to_unit(std::uint8_t unit, const NovatelDatagram& datagram);

  transport::UdpSocket socket_;
  std::vector<std::uint16_t> first_ports_;
};

}  // namespace pitwall::bench
