// Programs of this build: their paths, to start them, also inside a guest.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::cli {

// Path of this program.
std::string own_program();
// Path of another program of the same build, given by folder and name.
std::string beside(const std::string& program);

}  // namespace pitwall::cli
