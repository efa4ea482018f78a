// Rules about the text of one file.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/tidy/source_tree.hpp"

namespace pitwall::tidy {

std::vector<Finding> check_line_length(const SourceFile& file);
// Banned calls, each with its replacement: clocks, threads, random numbers, output, sleeping,
// assert, ...
std::vector<Finding> check_bans(const SourceFile& file);
std::vector<Finding> check_using_namespace(const SourceFile& file);
std::vector<Finding> check_leftovers(const SourceFile& file);
std::vector<Finding> check_machine_paths(const SourceFile& file);
// The SPDX line, and in headers the contract comment above it.
std::vector<Finding> check_opening(const SourceFile& file);

}  // namespace pitwall::tidy
