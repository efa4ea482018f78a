// Parts of a page of HTML that every report has: document, section, cell of a table, named fact.
//   in     titles, names and values as text, which is escaped; bodies and cells as HTML
//   out    HTML; document() is a whole page, with style and script in it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pitwall::report {

inline constexpr std::string_view kSimulated = "SIMULATION: no car was driven";

// `style`: what this page has beside the style of every page.
std::string document(std::string_view title, const std::string& body, std::string_view style = {});
std::string section(std::string_view title, const std::string& body);
std::string beside(const std::string& left, const std::string& right);
std::string in_two_columns(const std::vector<std::string>& parts);  // row by row
// In a list (<dl>); "not recorded" where there is no value.
std::string fact(std::string_view name, std::string_view value);
// `style`: class of the cell.
std::string cell(const std::string& html, std::string_view style = {});
std::string note(std::string_view text);

}  // namespace pitwall::report
