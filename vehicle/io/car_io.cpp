// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/car_io.hpp"

#include <utility>

#include "protocol/transport/clock.hpp"

namespace pitwall::io {
namespace {

// More than the receive queue of the socket holds (21,846 frames): what waits after a stall is read
// at once, else the newest frames would be taken for lost.
constexpr std::size_t kFramesPerRead = 22'528;

}  // namespace

CarIo::CarIo(transport::CanSocket can, std::unique_ptr<BusWatch> watch,
             std::vector<ReceiverPort> receivers)
    : can_(std::move(can)),
      watch_(std::move(watch)),
      receivers_(std::move(receivers)),
      frames_(kFramesPerRead) {}

Result<CarIo, Problem> CarIo::open(const Arguments& args, const world::Receivers& receivers) {
  auto can = transport::CanSocket::open(args.can_interface);
  if (!can) return Unexpected{can.error()};
  auto watch = BusWatch::start(args.can_interface);
  if (!watch) return Unexpected{watch.error()};
  auto ports = open_receivers(args.receivers, receivers);
  if (!ports) return Unexpected{ports.error()};
  return CarIo{*std::move(can), *std::move(watch), *std::move(ports)};
}

CarIo::Received CarIo::read(BlackBox& box) {
  Received received;
  const std::size_t count = can_.receive(frames_);
  const Instant now = transport::monotonic_now();
  poll_bus(now);
  received.link = link_;
  received.can = std::span<const can::ReceivedFrame>(frames_).first(count);
  for (std::size_t unit = 0; unit < receivers_.size(); ++unit) {
    receivers_[unit].read(received.sensors, now,
                          [&box, unit](Instant at, std::span<const std::uint8_t> bytes) {
                            box.receiver(unit, at, bytes);
                          });
    received.gnss_byte_at[unit] = receivers_[unit].byte_at();
  }
  return received;
}

void CarIo::poll_bus(Instant now) {
  can_.poll_drops();
  const bool flushing = watch_->flushing();  // first: a flush that ends now shows in one of the two
  const BusReport& report = watch_->newest();
  const std::uint64_t emptied = report.flushes + report.restarts;
  slots_.observe_queue({.bytes = can_.queued_bytes(), .flushed = flushing || emptied != emptied_},
                       now);
  emptied_ = emptied;
  if (slots_.should_flush(now) && report.flushes_refused == 0) watch_->flush();
  link_ = observer_.observe({.interface = report.interface,
                             .reported_by_frames = can_.bus_state(),
                             .reported_at = can_.bus_state_at(),
                             .lost_in_socket = can_.counters().rx_dropped_queue,
                             .error_frames = can_.counters().error_frames,
                             .tx_drops = tx_drops(),
                             .tx_stalled = slots_.stalled(now),
                             .down_and_up = report.down_and_up,
                             .hung_up = can_.hung_up()});
}

void CarIo::write(std::span<const can::Frame> frames, Instant now) {
  if (listen_only()) {
    listen_only_drops_ += frames.size();
    return;
  }
  slots_.offer(frames, now);
  // A controller that is off would keep them for the time after.
  const bool off = link_.controller == world::ControllerState::kBusOff ||
                   link_.controller == world::ControllerState::kDown;
  if (off) return;
  slots_.taken(can_.send(slots_.due(now)), now);
}

const char* CarIo::fresh_refusal() {
  const char* refusal = watch_->newest().refusal.data();
  if (refusal_reported_ || *refusal == '\0') return nullptr;
  refusal_reported_ = true;
  return refusal;
}

}  // namespace pitwall::io
