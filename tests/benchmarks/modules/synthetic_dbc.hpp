// Generator of a synthetic CAN database as large as one of a road car, to time a parser with.
//   in      the least size of the text
//   out     the text of a .dbc file with nodes, comments, names of values, attributes, floats and
//           multiplexing; the same at every call
//   units   bytes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace pitwall::benchmarks {

std::string synthetic_dbc(std::size_t least_bytes);

}  // namespace pitwall::benchmarks
