// Include rules: the layering table of the design as data, and rules about #include lines.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/tidy/source_tree.hpp"

namespace pitwall::tidy {

struct Include {
  std::string target;
  bool quoted = false;
  std::size_t line = 0;
};

std::vector<Include> includes_of(const SourceFile& file);

// Project headers and libraries that a part of the tree may not include.
std::vector<Finding> check_include_table(const SourceFile& file);
// Libraries whose headers take seconds to compile. In the product, only a .cpp may include them,
// and a few headers named in a table; these headers then count as heavy too.
std::vector<Finding> check_heavy_headers(const SourceFile& file);
// x.cpp includes x.hpp first, if that exists (`has_header`).
std::vector<Finding> check_own_header_first(const SourceFile& file, bool has_header);

}  // namespace pitwall::tidy
