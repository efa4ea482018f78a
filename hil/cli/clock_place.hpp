// Place of the time of a live run, by the option --clock.
//   in     "bench", "wall", the file in which bench time is kept, for programs on this machine that
//          were started with it; "host:FILE": likewise on the machine that a guest may be in;
//          empty: bench, or wall where a car is attached
//   out    the file here, and in a guest the line to the host, whose file is out of reach
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::cli {

struct ClockPlace {
  std::string file, line;  // empty: the wall clock; nobody follows elsewhere
  bool is_own = false;     // made for this run, to be removed after it
};

ClockPlace clock_place(const std::string& clock, bool attached, bool in_guest);
ClockPlace clock_place(const std::string& clock, bool attached);

// Whether it names a file; and the same file as a run in a guest has to name it.
bool is_clock_file(const std::string& clock);
std::string on_host(const std::string& clock);

}  // namespace pitwall::cli
