// Placeholder for a plot that cannot be drawn: its title and the reason, instead of an empty frame.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/text.hpp"

namespace pitwall::report {

inline std::string absent(const std::string& name, const std::string& title,
                          const std::string& why) {
  return "<p class=\"absent\" data-absent=\"" + escaped(name) + "\"><b>" + escaped(title) +
         "</b>: " + escaped(why) + "</p>\n";
}

}  // namespace pitwall::report
