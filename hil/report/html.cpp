// SPDX-License-Identifier: Apache-2.0
#include "hil/report/html.hpp"

#include "hil/report/page_assets.hpp"
#include "hil/report/text.hpp"

namespace pitwall::report {

std::string document(std::string_view title, const std::string& body, std::string_view style) {
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                    escaped(title) + "</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>";
  out.append(kPlotStyle).append(kStyle).append(style);
  out += "</style></head>\n<body>\n" + body + "<script>";
  return out.append(kScript) + "</script>\n</body></html>\n";
}

std::string section(std::string_view title, const std::string& body) {
  return "<section><h2>" + escaped(title) + "</h2>\n" + body + "</section>\n";
}

std::string beside(const std::string& left, const std::string& right) {
  return "<div class=\"beside\"><div>" + left + "</div><div>" + right + "</div></div>\n";
}

std::string in_two_columns(const std::vector<std::string>& parts) {
  std::string out;
  for (std::size_t i = 0; i < parts.size(); i += 2)
    out += beside(parts[i], i + 1 < parts.size() ? parts[i + 1] : "");
  return out;
}

std::string fact(std::string_view name, std::string_view value) {
  return "<div><dt>" + escaped(name) + "</dt><dd>" +
         (value.empty() ? "not recorded" : escaped(value)) + "</dd></div>";
}

std::string cell(const std::string& html, std::string_view style) {
  const std::string opening = style.empty() ? "<td>" : "<td class=\"" + std::string(style) + "\">";
  return opening + html + "</td>";
}

std::string note(std::string_view text) { return "<p class=\"note\">" + escaped(text) + "</p>\n"; }

}  // namespace pitwall::report
