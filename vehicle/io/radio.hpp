// Radio of the car process: one UDP socket per path, and the endpoint of the radio protocol.
// receive() is called before the step, send() after it.
//   in     arguments (addresses of base stations by path, key file), budgets of the car file; the
//          UTC time, once in open(), for the stamps of the key exchange; the newest snapshot
//   out    datagrams, marked as expedited forwarding; the endpoint, for the pipeline's RadioAdapter
//   errors open(): Problem with the address, the key file or the budget as place; afterwards
//          counters only
//   cost   no allocation after open(); at most kReadsPerTick datagrams are read per tick and path,
//          the rest in the next tick
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/telemetry/session/crypto/randomness.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/io/black_box.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::io {

struct RadioArguments {
  std::vector<std::string> stations;  // one per path, see station_addresses.hpp
  std::string key_file;
};

class Radio {
 public:
  static constexpr std::size_t kReadsPerTick = 512;

  // `real_car`: false marks the telemetry as a simulation, and accepts keys of a bench too.
  static Result<Radio, Problem> open(const RadioArguments& args,
                                     const pipeline::RadioParams& params, bool real_car);

  // Every datagram is recorded in `box`.
  void receive(BlackBox& box);
  bool due(Instant now) const { return endpoint_.due() <= now + kEarly; }
  void send(const telemetry::Snapshot& snapshot, Instant now, BlackBox& box);

  telemetry::CarEndpoint& endpoint() { return endpoint_; }
  const telemetry::CarEndpoint& endpoint() const { return endpoint_; }
  const transport::UdpCounters& counters(std::size_t path) const { return paths_[path].counters(); }
  bool bench_keys() const { return bench_keys_; }
  std::size_t paths() const { return paths_.size(); }
  UdpAddress local(std::size_t path) const { return paths_[path].local(); }

 private:
  // A tick at most this much before its slot serves it, because the next tick would be late.
  static constexpr Duration kEarly = milliseconds(2);

  Radio(const telemetry::LinkEndpointConfig& config, std::vector<transport::UdpSocket> paths);

  std::unique_ptr<telemetry::SystemRandomness> randomness_;
  telemetry::CarEndpoint endpoint_;
  std::vector<transport::UdpSocket> paths_;
  std::vector<transport::UdpDatagram> inbox_;
  bool bench_keys_ = false;
};

}  // namespace pitwall::io
