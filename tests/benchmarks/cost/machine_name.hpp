// Name of the machine of a measurement: processor, number of cores, kernel.
//   in     the text of /proc/cpuinfo (proc(5)) and the release of the kernel
//   out    "AMD EPYC, 2 cores, Linux 6.18.44"; a missing part is "unknown"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace pitwall::cost {

std::string machine_name(std::string_view cpuinfo, std::string_view release);
std::string machine_name();  // of this machine

}  // namespace pitwall::cost
