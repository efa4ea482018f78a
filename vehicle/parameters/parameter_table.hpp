// Table of the numbers of a car file for the reader: key, default and legal range, from the same
// rows that read and check the file. Numbers that depend on others, and lists, are not in it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::parameters {

// One line for each number, in the order of the file: "planning.line.spacing_m  required  0.5  5".
std::string parameter_table();

}  // namespace pitwall::parameters
