// Rules about the size of files and functions, the names of files, and tests that mirror the tree.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/tidy/source_tree.hpp"

namespace pitwall::tidy {

struct FunctionSpan {
  std::size_t first_line = 0, last_line = 0;

  std::size_t lines() const { return last_line - first_line + 1; }
};

// Functions defined at namespace or class level, found by matching braces; a lambda belongs to the
// function around it.
std::vector<FunctionSpan> functions_of(const SourceFile& file);

std::vector<Finding> check_file_size(const SourceFile& file);
std::vector<Finding> check_function_size(const SourceFile& file);
std::vector<Finding> check_file_name(const SourceFile& file);
// Over the whole tree: every .cpp except main.cpp, and every header with logic and without .cpp,
// has its test at the same place under tests/.
std::vector<Finding> check_mirrored_tests(const std::vector<SourceFile>& tree);
// Over the whole tree: the number of entries of a product folder with C++ is limited to what a
// newcomer can survey; a source and its header count as one entry.
std::vector<Finding> check_folder_size(const std::vector<SourceFile>& tree);

}  // namespace pitwall::tidy
