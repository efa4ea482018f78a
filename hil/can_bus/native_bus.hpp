// CAN interfaces of the machine's own kernel, virtual and real: creation, setup, status, removal.
//   in     interface names; settings of real interfaces
//   out    existing interfaces, their status as text
//   errors Problem: no CAN in this kernel, missing permission, or the error text of the driver
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

// Creates missing virtual interfaces and sets all of them up. nullopt: success.
std::optional<Problem> bring_up(std::span<const std::string> interfaces);
// Sets up real interfaces; an interface without a CAN controller is a Problem.
std::optional<Problem> bring_up(std::span<const std::string> interfaces,
                                const transport::CanInterfaceSettings& settings);
// Status report of several lines.
std::string status_text(std::string_view interface, const transport::CanInterfaceStatus& status);
// Removes virtual interfaces; a missing one is ignored, a real one is a Problem.
std::optional<Problem> take_down(std::span<const std::string> interfaces);

}  // namespace pitwall::can_bus
