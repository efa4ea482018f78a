// Rule against private names for which the field has a term: a list of exact identifiers, each with
// the folders where it is banned and the term to write instead.
//   in     one file, in C++ or of the console
//   out    each line that uses such an identifier in code; comments and string literals are free
//   source the terms are those of docs/glossary.md, of SocketCAN, DBC, ROS 2 and alarm handling
//          (ISA-18.2)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/tidy/source_tree.hpp"

namespace pitwall::tidy {

std::vector<Finding> check_identifiers(const SourceFile& file);

}  // namespace pitwall::tidy
