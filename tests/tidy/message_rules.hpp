// Rule about the texts of error messages in the code.
//   in     one file of the product
//   out    each message with its line: the string literals, with "..." for a value between them. An
//          expression without literal text is no message. A returned sentence is one as well, since
//          checks return what is wrong to a caller that knows the place (among them are some texts
//          of screens)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/tidy/source_tree.hpp"

namespace pitwall::tidy {

struct ErrorMessage {
  std::size_t line = 0;
  std::string text;
  bool is_returned = false;  // the caller may put words before it
};

std::vector<ErrorMessage> messages_of(const SourceFile& file);

// A message says what was wrong, or says "expected ..."; "a number" alone is neither.
std::vector<Finding> check_messages(const SourceFile& file);

}  // namespace pitwall::tidy
