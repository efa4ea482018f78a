// YAML text with other values in it: of a parameter of a sweep, of a search.
//   in     a document, its name for messages; settings: a path and a value as it would be typed
//   path   keys and places in lists from the root: "perturb.friction", "faults[0].value". A mapping
//          or a key that is missing is added; a list gets no new entries
//   out    the document with these values, all else as it was but for comments and layout
//   errors Problem with the document and the path: it passes through a value, or beyond a list; the
//          text is no YAML
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::yaml {

struct Setting {
  std::string path, value;
};

Result<std::string, Problem> with_settings(std::string_view text, const std::string& name,
                                           std::span<const Setting> settings);

}  // namespace pitwall::yaml
