// Location of the clock of a live run, as the option --clock gives it.
//   in     "bench": a bench time of this run; "wall": the wall clock; FILE: the bench time in this
//          file, with which other programs on this machine were started; "host:FILE": a file of the
//          host, even if this program runs in a guest. Empty: "bench", or "wall" if a car is
//          attached
//   out    the file on this machine; in a guest also the serial line to the host, whose file the
//          guest cannot access
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::cli {

struct ClockPlace {
  std::string file, line;  // file empty: the wall clock; line empty: no follower
  bool is_own = false;     // created for this run and to be removed after it
};

ClockPlace clock_place(const std::string& clock, bool attached, bool in_guest);
ClockPlace clock_place(const std::string& clock, bool attached);

// True if the option names a file; and the same file as a run in a guest has to name it.
bool is_clock_file(const std::string& clock);
std::string on_host(const std::string& clock);

}  // namespace pitwall::cli
