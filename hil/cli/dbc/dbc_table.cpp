// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc/dbc_table.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

using can::Message;
using can::Signal;

constexpr std::size_t kColumns = 7;
constexpr std::size_t kMostTextColumns = 60;  // of an unused section
using Row = std::array<std::string, kColumns>;

// Characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

const char* kind_of(const can::SignalLayout& l) {
  switch (l.number) {
    case can::Number::kUnsigned:
      return "unsigned";
    case can::Number::kSigned:
      return "signed";
    case can::Number::kFloat32:
      return "float";
    case can::Number::kFloat64:
      return "double";
  }
  return "";
}

std::string presence(const Message& m, const Signal& s) {
  std::string out = s.is_selector ? "multiplexer " : "";
  if (!s.selector) return out;
  std::string values;
  for (const can::SelectorRange& r : s.when) {
    values += (values.empty() ? "" : ", ") + std::to_string(r.low) +
              (r.low == r.high ? "" : "-" + std::to_string(r.high));
  }
  return out + "while " + m.signals[*s.selector].name + " is " + values;
}

Row row_of(const Message& m, const Signal& s) {
  const can::SignalLayout& l = s.layout;
  const std::string range =
      l.min < l.max ? "[" + shortest(l.min) + "|" + shortest(l.max) + "]" : "-";
  const std::string offset = l.offset == 0.0  ? ""
                             : l.offset > 0.0 ? " +" + shortest(l.offset)
                                              : " " + shortest(l.offset);
  return {(s.is_flawed ? "! " : "  ") + s.name,
          std::to_string(l.start) + "|" + std::to_string(l.length) +
              (l.order == can::ByteOrder::kIntel ? " Intel" : " Motorola"),
          kind_of(l),
          "x" + shortest(l.scale) + offset,
          range,
          s.unit,
          presence(m, s)};
}

std::string names_of_values(const Signal& s) {
  std::string out;
  for (const can::ValueName& v : s.values) {
    out += (out.empty() ? "      " : ", ") + std::to_string(v.value) + " " + v.name;
  }
  return out.empty() ? out : out + "\n";
}

std::string heading_of(const Message& m) {
  std::string out = m.name + "  id " + std::to_string(m.id) + " (" + hex(m.id) +
                    (m.extended ? ", extended" : "") + ")  " + std::to_string(m.length) + " bytes" +
                    (m.fd ? " CAN FD" : "") +
                    (m.is_on_frame() ? "" : ", not on a CAN frame (J1939 transport)") + "  ";
  out += m.period == Duration{} ? "period not given" : shortest(m.period.seconds() * 1e3) + " ms";
  out += "  from " + m.sender;
  for (const std::string& name : m.other_senders) out += ", " + name;
  return out + "\n";
}

std::string first_line(std::string_view text) {
  const std::size_t end = std::min(text.find('\n'), kMostTextColumns);
  return std::string{text.substr(0, end)} + (end < text.size() ? " ..." : "");
}

std::string errors_outside_messages(const can::Database& d) {
  std::set<std::string_view> inside;
  for (const Message& m : d.messages) {
    for (const Problem& flaw : m.flaws) inside.insert(flaw.place);
  }
  std::string out;
  for (const can::Finding& f : d.findings) {
    if (can::severity_of(f.kind) != can::FindingSeverity::kError) continue;
    if (!inside.contains(f.place)) out += "! " + f.place + ": " + can::text_of(f) + "\n";
  }
  return out.empty() ? out : "\nerrors outside of these messages\n" + out;
}

}  // namespace

std::string summary_of(const can::Database& d) {
  std::size_t signals = 0;
  for (const Message& m : d.messages) signals += m.signals.size();
  const std::size_t errors = d.count(can::FindingSeverity::kError);
  return std::to_string(d.messages.size()) + " messages, " + std::to_string(signals) +
         " signals, " + std::to_string(d.nodes.size()) + " nodes; " +
         std::to_string(d.unused.size()) + " sections unused; fingerprint " +
         hex(can::fingerprint(d)) + (errors == 0 ? "" : "; " + std::to_string(errors) + " errors");
}

std::string table_of(const Message& m) {
  std::vector<Row> rows;
  std::array<std::size_t, kColumns> widths{};
  for (const Signal& s : m.signals) {
    rows.push_back(row_of(m, s));
    for (std::size_t c = 0; c < kColumns; ++c) {
      widths[c] = std::max(widths[c], width_of(rows.back()[c]));
    }
  }
  std::string out = heading_of(m);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::string line;
    for (std::size_t c = 0; c < kColumns; ++c) {
      line += rows[i][c] + std::string(widths[c] - width_of(rows[i][c]) + 2, ' ');
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n" + names_of_values(m.signals[i]);
  }
  for (const Problem& flaw : m.flaws) out += "! " + flaw.place + ": " + flaw.what + "\n";
  return out;
}

std::string table_of(const can::Database& d) {
  std::string out = d.name + ": " + summary_of(d) + "\n";
  for (const Message& m : d.messages) out += "\n" + table_of(m);
  if (!d.unused.empty()) out += "\nunused sections\n";
  for (const can::Section& s : d.unused) out += "  " + s.place + ": " + first_line(s.text) + "\n";
  return out + errors_outside_messages(d);
}

}  // namespace pitwall::cli
