// Name of the machine that a figure was taken on: its processor, how many of them, its kernel.
//   in     the text of /proc/cpuinfo (proc(5)) and the kernel's release
//   out    "AMD EPYC, 2 cores, Linux 6.18.44"; what is not told is "unknown"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace pitwall::cost {

std::string machine_name(std::string_view cpuinfo, std::string_view release);
std::string machine_name();  // of this one

}  // namespace pitwall::cost
