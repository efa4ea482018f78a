// Conversion between the kernel's CAN frame layouts (struct can_frame, struct canfd_frame) and
// can::Frame, and decoder of the kernel's error frames. Pure: no system call, works without CAN in
// the kernel.
//   in     bytes as read from a CAN_RAW socket (16 classic, 72 FD), or a can::Frame
//   out    the other form; false or 0 if the frame has no equivalent there
//   source Linux Documentation/networking/can.rst, include/uapi/linux/can/error.h
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/can.h>
#include <linux/can/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "protocol/can/frame.hpp"

namespace pitwall::transport {

inline constexpr std::size_t kCanWireBytes = CAN_MTU;      // 16
inline constexpr std::size_t kCanFdWireBytes = CANFD_MTU;  // 72
static_assert(kCanWireBytes == 16 && kCanFdWireBytes == 72);
static_assert(offsetof(can_frame, data) == offsetof(canfd_frame, data));

using CanWire = canfd_frame;  // room for both layouts; the first 16 bytes are a can_frame

// CAN FD data field lengths; no other length exists on a wire.
constexpr bool is_fd_length(std::size_t n) {
  return n <= 8 || n == 12 || n == 16 || n == 20 || n == 24 || n == 32 || n == 48 || n == 64;
}

// True for a frame that a bus can carry: id in range, length allowed, FD never remote.
constexpr bool is_sendable(const can::Frame& f) {
  if (f.id > (f.extended ? can::kMaxExtendedId : can::kMaxStandardId)) return false;
  if (f.fd) return !f.remote && is_fd_length(f.length);
  return f.length <= CAN_MAX_DLEN;
}

// Number of bytes to write to the socket (16 or 72); 0 if the frame is not sendable.
inline std::size_t to_wire(const can::Frame& f, CanWire& out) {
  if (!is_sendable(f)) return 0;
  out = CanWire{};
  out.can_id = f.id | (f.extended ? CAN_EFF_FLAG : 0U) | (f.remote ? CAN_RTR_FLAG : 0U);
  out.len = f.length;
  if (!f.remote) std::memcpy(out.data, f.data.data(), f.length);
  return f.fd ? kCanFdWireBytes : kCanWireBytes;
}

// False for an error frame (see decode_error) and for a size or length that no frame has.
inline bool from_wire(const CanWire& wire, std::size_t bytes, can::Frame& out) {
  const bool fd = bytes == kCanFdWireBytes;
  if (!fd && bytes != kCanWireBytes) return false;
  if ((wire.can_id & CAN_ERR_FLAG) != 0U) return false;
  if (wire.len > (fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN)) return false;
  out = can::Frame{};
  out.extended = (wire.can_id & CAN_EFF_FLAG) != 0U;
  out.remote = !fd && (wire.can_id & CAN_RTR_FLAG) != 0U;
  out.fd = fd;
  out.id = wire.can_id & (out.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  out.length = wire.len;
  if (!out.remote) std::memcpy(out.data.data(), wire.data, wire.len);
  return true;
}

constexpr bool is_error_frame(const CanWire& wire) { return (wire.can_id & CAN_ERR_FLAG) != 0U; }

// True for an error frame, and for a frame that a wire can carry. Stricter than vcan, which also
// forwards identifiers and lengths that no wire has.
inline bool is_carried(const CanWire& wire, std::size_t bytes) {
  if (is_error_frame(wire))
    return bytes == kCanWireBytes && wire.len <= CAN_MAX_DLEN &&
           (wire.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) == 0U;
  if ((wire.can_id & CAN_EFF_FLAG) == 0U && (wire.can_id & CAN_EFF_MASK) > CAN_SFF_MASK)
    return false;
  if (bytes == kCanWireBytes) return wire.len <= CAN_MAX_DLEN;
  return bytes == kCanFdWireBytes && (wire.can_id & CAN_RTR_FLAG) == 0U && is_fd_length(wire.len);
}

// Error state of the controller in the kernel's last report; kUnknown before the first one.
enum class BusState : std::uint8_t { kUnknown, kActive, kWarning, kPassive, kBusOff };

struct CanErrorCounters {
  std::uint64_t tx_timeout = 0, lost_arbitration = 0, controller = 0, protocol = 0;
  std::uint64_t transceiver = 0, no_acknowledgement = 0, bus_off = 0, bus_error = 0;
  std::uint64_t restarted = 0;

  bool operator==(const CanErrorCounters&) const = default;
};

// The state that an error frame reports; kUnknown if it reports none.
inline BusState state_in(const CanWire& wire) {
  if ((wire.can_id & CAN_ERR_BUSOFF) != 0U) return BusState::kBusOff;
  if ((wire.can_id & CAN_ERR_RESTARTED) != 0U) return BusState::kActive;
  if ((wire.can_id & CAN_ERR_CRTL) == 0U) return BusState::kUnknown;
  const unsigned detail = wire.data[1];
  if ((detail & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0U)
    return BusState::kPassive;
  if ((detail & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0U)
    return BusState::kWarning;
  if ((detail & CAN_ERR_CRTL_ACTIVE) != 0U) return BusState::kActive;
  return BusState::kUnknown;
}

// Adds one error frame to the counters (it may have several classes) and returns the bus state
// after it: `before` if the frame does not report a state.
inline BusState decode_error(const CanWire& wire, BusState before, CanErrorCounters& counters) {
  const std::uint32_t classes = wire.can_id;
  counters.tx_timeout += (classes & CAN_ERR_TX_TIMEOUT) != 0U;
  counters.lost_arbitration += (classes & CAN_ERR_LOSTARB) != 0U;
  counters.controller += (classes & CAN_ERR_CRTL) != 0U;
  counters.protocol += (classes & CAN_ERR_PROT) != 0U;
  counters.transceiver += (classes & CAN_ERR_TRX) != 0U;
  counters.no_acknowledgement += (classes & CAN_ERR_ACK) != 0U;
  counters.bus_off += (classes & CAN_ERR_BUSOFF) != 0U;
  counters.bus_error += (classes & CAN_ERR_BUSERROR) != 0U;
  counters.restarted += (classes & CAN_ERR_RESTARTED) != 0U;
  const BusState reported = state_in(wire);
  return reported == BusState::kUnknown ? before : reported;
}

}  // namespace pitwall::transport
