// `pitwall-hil replay FILE`: a recorded CAN log of any format, or a recording with sensor traffic,
// onto CAN interfaces and to the addresses of receivers, in real time.
//
//   replay FILE [--interface vcan0] [--map can0=vcan0]...
//          [--receiver /gnss/0=127.0.0.1:3001]... [--speed X] [--loop N] [--from S] [--until S]
//          [--skip S] [--topic NAME]... [--id HEX]... [--not-id HEX]...
//          [--overlay NODE]... [--dbc FILE] [--restamp MANIFEST]
//          [--late catch-up|drop:MS|abort:MS] [--spin US] [--clock wall|FILE]
//          [--json FILE] [--progress]
//
// Without --interface and --map every channel of a log goes to the interface it was recorded from.
//   --receiver sends the bytes of a receiver of a recording as UDP datagrams; to tcp:ADDRESS:PORT
//              the car connects as to a real receiver, and serial:/dev/ttyUSB0[:BAUD] is the other
//              end of its line. What such a stream does not take is dropped and counted
//   --from, --until  seconds since the first stamp: what lies before and after is left out
//   --topic    only these sources of a recording or channels of a log; --id only these frames,
//              --not-id but these. A name or an identifier that does not occur is an error
//   --overlay  all but what this node of the database sends (--dbc, else that of --restamp), so
//              that a plant or a simulated node can send it
//   --dds      publishes the ROS 2 topics of a recording with their bytes, names and types, on
//              loopback unless DOMAIN@ADDRESS names another interface
//   --restamp  rolling counters and checksums made anew by the manifest of a car: a receiver
//              accepts loops, parts and filtered logs
//   --skip     seconds: does not wait through longer gaps
//   --late     what becomes of a frame or datagram that is later than that many milliseconds
//              (default catch-up: it is sent at once)
//   --spin     wakes up so many microseconds early and waits busily for the rest, 0 to 200; takes
//              that time from other programs of the processor. Default: what sleeps are usually
//              late on this machine, measured at the start
//   --clock    FILE: bench time (replay_clock.hpp), kept by who keeps it there, or else by the
//              replay; sleeps are plain then. Default: wall
//   --progress how far reading the file is, once a second, also where there is no terminal
//   out    frames and datagrams sent, lateness, what was dropped or not played, and which real-time
//          rights the kernel granted, on standard output; exit code 0: everything was sent;
//          1: some were dropped, or the replay was aborted or stopped; 2: wrong usage, a file that
//          does not read, or no such interface. Records that do not read are told with their
//          places, on standard error
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::replay {

int replay_verb(std::span<const std::string> args);

}  // namespace pitwall::replay
