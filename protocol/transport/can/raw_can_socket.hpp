// Raw socket on a CAN interface of the kernel.
//   in     name of the interface; `set_options`, called before the socket is bound, so that no
//          frame comes in under other options
//   out    a bound socket that never blocks
//   errors Problem with the interface's name: no CAN in this kernel, no such interface, an option
//          or the binding refused
//   source Linux Documentation/networking/can.rst
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

Result<FileDescriptor, Problem> open_raw_can_socket(
    const std::string& interface, const std::function<PosixOutcome(int fd)>& set_options);

// Whether this kernel has CAN.
bool has_can();

}  // namespace pitwall::transport
