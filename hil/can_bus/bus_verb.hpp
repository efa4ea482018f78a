// Subcommand `pitwall-hil bus`: a CAN bus to work with, from this kernel or from a guest.
//
//   bus check                 reports whether CAN is native or from a guest; 0 if either works
//   bus up [IFACE]...         native only: creates virtual CAN interfaces (default vcan0)
//   bus up IFACE [--bitrate BIT/S] [--restart-ms MS] [--listen-only] [--txqueuelen FRAMES]
//                             sets up a real CAN interface; settings that are not given stay, but
//                             without --listen-only that mode is switched off
//   bus status IFACE...       prints state, settings and counters
//   bus down [IFACE]...       native only: removes virtual interfaces
//   bus hub PATH [--seconds S] [--clock FILE]
//                             serves the bus unix:PATH until SIGTERM, or for S seconds, and prints
//                             its counters at the end; needs neither CAN nor root
//   bus exec [--guest|--native|--auto] [--interface IFACE]... [--timeout S] [--memory MIB]
//            [--line-udp HOST_LISTEN:HOST_DEST:GUEST_LISTEN:GUEST_DEST] -- COMMAND ARG...
//                             runs COMMAND where the interfaces exist; its output is forwarded
//   bus line LISTEN DEST [READY_FILE]    guest end of --line-udp; the guest starts it
//
// With --line-udp, datagrams of COMMAND to 127.0.0.1:GUEST_LISTEN arrive on the host at
// 127.0.0.1:HOST_DEST, and datagrams of the host to 127.0.0.1:HOST_LISTEN arrive in the guest at
// 127.0.0.1:GUEST_DEST. Without a guest the same ports are connected on the host (HOST_LISTEN to
// GUEST_DEST, GUEST_LISTEN to HOST_DEST), so COMMAND runs unchanged in both places; all four ports
// must then differ.
//   out    exit code: that of COMMAND; 2 wrong usage or no CAN; 124 time-out; 125 the guest failed
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
