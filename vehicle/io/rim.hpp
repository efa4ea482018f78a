// Bus and receivers of the car process: CAN socket, ports of the receivers. read() before the step,
// write() after it. The radio is radio.hpp's.
//   in     Arguments; what the car file says of the receivers
//   out    what arrived since the last read; counters
//   errors open(): Problem that names the interface or the link; afterwards counters only
//   cost   no allocation after open()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/io/arguments/arguments.hpp"
#include "vehicle/io/black_box.hpp"
#include "vehicle/io/bus_watch.hpp"
#include "vehicle/io/link_observer.hpp"
#include "vehicle/io/receiver_port.hpp"
#include "vehicle/io/transmit_slots.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::io {

class Rim {
 public:
  static Result<Rim, Problem> open(const Arguments& args, const world::Receivers& receivers = {});

  struct Received {
    std::span<const can::ReceivedFrame> can;  // valid until the next read()
    world::SensorInput sensors;
    world::LinkObservation link;
    std::array<std::optional<Instant>, world::kGnssUnits> gnss_byte_at;  // newest, if any
  };
  // The box is told every byte of the receivers.
  Received read(BlackBox& box);
  // Frames of this tick, in order of urgency. What cannot go out in time is dropped and counted; on
  // a listen-only interface that is all of it.
  void write(std::span<const can::Frame> frames, Instant now);
  // Asks for a restart of the controller; carried out beside the loop.
  void restart_bus() { watch_->restart(); }

  const transport::CanSocketCounters& can() const { return can_.counters(); }
  std::span<const ReceiverPort> receivers() const { return receivers_; }
  const TransmitCounters& transmit() const { return slots_.counters(); }
  // Frames that did not go out in time: a command is never sent late.
  std::uint64_t tx_drops() const { return slots_.counters().dropped() + silenced_; }
  void poll_drops() { can_.poll_drops(); }
  const BusReport& bus() { return watch_->newest(); }
  // Why the kernel refused what the car wanted of the bus; once, when it first did.
  const char* fresh_refusal();
  // The interface only listens: nothing is ever sent, and the car must not be armed.
  bool listen_only() { return bus().interface.listen_only; }

 private:
  Rim(transport::CanSocket can, std::unique_ptr<BusWatch> watch,
      std::vector<ReceiverPort> receivers);
  void look_at_bus(Instant now);

  transport::CanSocket can_;
  std::unique_ptr<BusWatch> watch_;
  TransmitSlots slots_;
  LinkObserver observer_;
  world::LinkObservation link_;
  bool refusal_reported_ = false;
  std::uint64_t emptied_ = 0;  // how often the kernel's queue has been, as of the last look
  std::vector<ReceiverPort> receivers_;
  std::vector<can::ReceivedFrame> frames_;
  std::uint64_t silenced_ = 0;  // frames not sent because the interface only listens
};

}  // namespace pitwall::io
