// A function of an anonymous namespace that hides a function of a header: where several files are
// compiled as one, the files behind it would call it instead, without a word of the compiler.
//   in     the whole tree
//   out    functions of anonymous namespaces with the name, the namespace and the types of the
//          parameters of a function that a header of the same top-level folder declares
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/tidy/source_tree.hpp"

namespace pitwall::tidy {

struct DeclaredFunction {
  std::string space;  // "pitwall::safety"; an anonymous namespace is left out
  std::string name;
  std::string types;  // of the parameters: without const, references, qualifiers, names, defaults
  bool anonymous = false;
  std::size_t line = 0;
};

// Functions declared or defined at namespace level.
std::vector<DeclaredFunction> declared_functions(const SourceFile& file);

std::vector<Finding> check_hidden_names(const std::vector<SourceFile>& tree);

}  // namespace pitwall::tidy
