// Subcommand `pitwall-hil replay FILE`: playback of a CAN log of any format, or of a recording with
// sensor traffic, onto CAN interfaces and to the addresses of receivers, in real time.
//
//   replay FILE [--interface vcan0] [--map can0=vcan0]...
//          [--receiver /gnss/0=127.0.0.1:3001]... [--dds DOMAIN[@ADDRESS]] [--speed X] [--loop N]
//          [--from S] [--until S] [--skip S] [--topic NAME]... [--id HEX]... [--not-id HEX]...
//          [--overlay NODE]... [--dbc FILE] [--restamp MANIFEST]
//          [--late catch-up|drop:MS|abort:MS] [--spin US] [--clock wall|FILE]
//          [--json FILE] [--progress]
//
// Without --interface and --map every channel of a log goes to the interface it was recorded from.
//   --receiver sends the bytes of a receiver of a recording as UDP datagrams. With
//              tcp:ADDRESS:PORT the car connects as to a real receiver; serial:/dev/ttyUSB0[:BAUD]
//              is the other end of a serial line. Bytes that such a stream does not take are
//              dropped and counted
//   --from, --until  seconds since the first stamp: records before and after are left out
//   --topic    plays only these sources of a recording or channels of a log; --id plays only these
//              frames, --not-id all others. A name or identifier that does not occur is an error
//   --overlay  leaves out the frames that this node of the database sends (--dbc, else that of
//              --restamp), so that a plant or a simulated node can send them
//   --dds      publishes the ROS 2 topics of a recording with their bytes, names and types, on
//              loopback unless DOMAIN@ADDRESS names another interface
//   --restamp  recomputes rolling counters and checksums by the manifest of a car, so that a
//              receiver accepts loops, parts and filtered logs
//   --skip     seconds: longer gaps are skipped
//   --late     what happens to a frame or datagram that is later than that many milliseconds
//              (default catch-up: it is sent at once)
//   --spin     wakes up that many microseconds early and waits busily for the rest, 0 to 200; this
//              takes processor time from other programs. Default: the usual lateness of a sleep on
//              this machine, measured at the start
//   --clock    FILE: bench time (replay_clock.hpp), kept by the process that keeps it already, else
//              by the replay; there is no busy waiting then. Default: wall
//   --progress reports the progress of reading the file once a second, even without a terminal
//   out    frames and datagrams sent, lateness, what was dropped or not played, and which real-time
//          rights the kernel granted, on standard output. Exit code 0: everything was sent; 1: some
//          were dropped, or the replay was aborted or stopped; 2: wrong usage, an unreadable file,
//          or no such interface. Unreadable records are listed with their places on standard error
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::replay {

int replay_verb(std::span<const std::string> args);

}  // namespace pitwall::replay
