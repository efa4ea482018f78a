// Virtual CAN interfaces of this machine's own kernel.
//   in     interface names
//   out    whether they exist now
//   errors Problem: no CAN in this kernel, or not allowed to make interfaces
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::guest {

bool interface_exists(const std::string& name);

// Makes those that are missing and sets all of them up. Nothing: they are there.
std::optional<Problem> bring_up(std::span<const std::string> interfaces);
// Removes virtual interfaces; one that does not exist is no problem, a real one is.
std::optional<Problem> take_down(std::span<const std::string> interfaces);

}  // namespace pitwall::guest
