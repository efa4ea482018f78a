// Rule against functions of an anonymous namespace that hide a function of a header. If several
// files are compiled as one, the files after it would call that function instead of the one in the
// header, and the compiler does not warn.
//   in     the whole tree
//   out    functions of anonymous namespaces with the name, namespace and parameter types of a
//          function that a header of the same top-level folder declares
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/tidy/source_tree.hpp"

namespace pitwall::tidy {

struct DeclaredFunction {
  std::string space;  // "pitwall::safety"; without anonymous namespaces
  std::string name;
  std::string types;  // of the parameters: without const, references, qualifiers, names, defaults
  bool anonymous = false;
  std::size_t line = 0;
};

// Functions declared or defined at namespace level.
std::vector<DeclaredFunction> declared_functions(const SourceFile& file);

std::vector<Finding> check_hidden_names(const std::vector<SourceFile>& tree);

}  // namespace pitwall::tidy
