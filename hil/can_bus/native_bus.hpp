// CAN interfaces of this machine's own kernel, virtual and real.
//   in     interface names; settings of real ones
//   out    whether they exist now, and how they are
//   errors Problem: no CAN in this kernel, not allowed, or refused by the driver, in its own words
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/transport/can/can_interface.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can_bus {

bool interface_exists(const std::string& name);

// Makes those that are missing and sets all of them up. Nothing: they are there.
std::optional<Problem> bring_up(std::span<const std::string> interfaces);
// Sets up real interfaces; one without a CAN controller is a problem.
std::optional<Problem> bring_up(std::span<const std::string> interfaces,
                                const transport::CanInterfaceSettings& settings);
// Some lines for people.
std::string status_text(std::string_view interface, const transport::CanInterfaceStatus& status);
// Removes virtual interfaces; one that does not exist is no problem, a real one is.
std::optional<Problem> take_down(std::span<const std::string> interfaces);

}  // namespace pitwall::can_bus
