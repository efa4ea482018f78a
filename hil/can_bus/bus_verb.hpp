// `pitwall-hil bus`: a CAN bus to work with, from this kernel or from a guest.
//
//   bus check                 says whether CAN is native or comes from a guest; 0 if either works
//   bus up [IFACE]...         native only: makes virtual CAN interfaces (default vcan0)
//   bus up IFACE [--bitrate BIT/S] [--restart-ms MS] [--listen-only] [--txqueuelen FRAMES]
//                             sets up a real CAN interface; what is not given stays as it is, but
//                             listening only
//   bus status IFACE...       its state, settings and counters
//   bus down [IFACE]...       native only: removes virtual ones
//   bus hub PATH [--seconds S] [--clock FILE]
//                             serves the bus unix:PATH until SIGTERM, or for S seconds, and prints
//                             its counters at the end; needs no CAN and no root
//   bus exec [--guest|--native|--auto] [--interface IFACE]... [--timeout S] [--memory MIB]
//            [--line-udp HOST_LISTEN:HOST_DEST:GUEST_LISTEN:GUEST_DEST] -- COMMAND ARG...
//                             runs COMMAND where the interfaces exist; its output is forwarded
//   bus line LISTEN DEST [READY_FILE]    the guest's end of --line-udp; started by the guest
//
// With --line-udp, what COMMAND sends to 127.0.0.1:GUEST_LISTEN arrives on the host at
// 127.0.0.1:HOST_DEST, and what the host sends to 127.0.0.1:HOST_LISTEN arrives in the guest at
// 127.0.0.1:GUEST_DEST. Without a guest the same ports are joined on the host (a -> d, c -> b), so
// COMMAND never needs to know where it runs; all four ports must then differ.
//   out    exit code: of COMMAND; 2 wrong usage or no CAN; 124 time-out; 125 the guest failed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::can_bus {

inline constexpr int kExitUsage = 2;
inline constexpr int kExitTimeout = 124;
inline constexpr int kExitGuestFailed = 125;

int bus_verb(std::span<const std::string> args);

}  // namespace pitwall::can_bus
