// Mutations of the shipped car file: mechanical changes of its text like typing errors, each with
// the line that it changes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "vehicle/parameters/car_file.hpp"

namespace pitwall::parameters::testing {

inline const std::string& av21() {
  static const std::string text = [] {
    std::ifstream file(std::filesystem::path(PITWALL_SOURCE_DIR) / "vehicle/config/cars/av21.yaml",
                       std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }();
  return text;
}

// The reason why the text is refused; empty if it is valid.
inline std::string refusal(const std::string& text) {
  const auto car = read_car(text, "car.yaml");
  return car ? std::string{} : to_string(car.error());
}

// A piece of the text: [from, to), on `line` (from 1).
struct Piece {
  std::size_t from, to, line;
  std::string text;
};

// Calls fn(offset of the line, line without its comment, line number).
template <class Fn>
void each_line(const std::string& text, Fn fn) {
  std::size_t from = 0, number = 0;
  while (from < text.size()) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    std::string line = text.substr(from, end - from);
    if (const std::size_t hash = line.find('#'); hash != std::string::npos) line.resize(hash);
    fn(from, line, ++number);
    from = end + 1;
  }
}

inline bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// Every number that is a value or an element of a list.
inline std::vector<Piece> numbers(const std::string& text) {
  std::vector<Piece> found;
  each_line(text, [&](std::size_t offset, const std::string& line, std::size_t number) {
    for (std::size_t i = 0; i < line.size();) {
      const bool starts = i > 0 && (line[i - 1] == ' ' || line[i - 1] == '[') &&
                          (std::isdigit(static_cast<unsigned char>(line[i])) || line[i] == '-');
      std::size_t end = i;
      while (starts && end < line.size() &&
             (std::isalnum(static_cast<unsigned char>(line[end])) || line[end] == '.' ||
              line[end] == '-' || line[end] == '+'))
        ++end;
      if (end > i + (line[i] == '-' ? 1U : 0U))
        found.push_back({offset + i, offset + end, number, line.substr(i, end - i)});
      i = std::max(end, i + 1);
    }
  });
  return found;
}

inline std::vector<Piece> keys(const std::string& text) {
  std::vector<Piece> found;
  each_line(text, [&](std::size_t offset, const std::string& line, std::size_t number) {
    for (std::size_t colon = line.find(':'); colon != std::string::npos;
         colon = line.find(':', colon + 1)) {
      std::size_t from = colon;
      while (from > 0 && is_of_word(line[from - 1])) --from;
      if (from < colon)
        found.push_back({offset + from, offset + colon, number, line.substr(from, colon - from)});
    }
  });
  return found;
}

// Lines with content.
inline std::vector<Piece> lines(const std::string& text) {
  std::vector<Piece> found;
  each_line(text, [&](std::size_t offset, const std::string& line, std::size_t number) {
    if (line.find_first_not_of(" ") == std::string::npos) return;
    const std::size_t end = std::min(text.find('\n', offset), text.size() - 1);
    found.push_back({offset, end + 1, number, line});
  });
  return found;
}

inline std::string replaced(const std::string& text, const Piece& piece, const std::string& by) {
  return text.substr(0, piece.from) + by + text.substr(piece.to);
}

// The text with the first `what` replaced; throws if `what` is not in it.
inline std::string with(const std::string& text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::runtime_error("not in the file: " + what);
  return replaced(text, {at, at + what.size(), 0, what}, by);
}

// Path of the number: "control.lateral.brackets[3].q[0]". Requires one key per line and flow
// mappings, as in the shipped file.
inline std::string path_of(const std::string& text, const Piece& number) {
  std::vector<std::pair<std::size_t, std::string>> open;  // indentation, name
  std::size_t item = 0;
  std::string path;
  each_line(text, [&](std::size_t offset, const std::string& line, std::size_t at) {
    const std::size_t indent = line.find_first_not_of(" ");
    if (indent == std::string::npos || at > number.line) return;
    const bool is_item = line[indent] == '-';
    item = is_item ? item + 1 : 0;
    std::string name = is_item ? "[" + std::to_string(item - 1) + "]"
                               : "." + line.substr(indent, line.find(':') - indent);
    while (!open.empty() && open.back().first >= indent) open.pop_back();
    open.emplace_back(indent, std::move(name));
    if (at != number.line) return;
    for (const auto& [_, part] : open) path += part;
    const std::string before = line.substr(0, number.from - offset);
    if (const std::size_t brace = before.rfind('{'); brace != std::string::npos) {
      const std::size_t colon = before.rfind(':');
      std::size_t from = colon;
      while (is_of_word(before[from - 1])) --from;
      path += "." + before.substr(from, colon - from);
    }
    if (const std::size_t list = before.rfind('[');
        list != std::string::npos && before.find(']', list) == std::string::npos)
      path += "[" +
              std::to_string(std::count(before.begin() + static_cast<std::ptrdiff_t>(list),
                                        before.end(), ',')) +
              "]";
  });
  return path.substr(1);
}

// Parameters of a module, by the path of the number in the file and in the file's unit.
using Reported = std::map<std::string, double>;

// Other numbers that are probably valid too; integers for an integer.
inline std::vector<std::string> neighbours(const std::string& number) {
  const double value = std::stod(number);
  if (number.find_first_of(".e") == std::string::npos) {
    const auto whole = static_cast<long long>(value);
    return {std::to_string(whole + 1), std::to_string(whole - 1)};
  }
  if (value == 0.0) return {"0.01"};
  std::ostringstream more, less;
  more << value * 1.02, less << value * 0.98;
  return {more.str(), less.str()};
}

// Each number of the section changes the parameter of its own name, to the written value, and no
// other parameter.
template <class Read>
void expect_each_number_to_move_its_own(const std::string& section, Read read) {
  const auto parsed = [](const std::string& text) {
    auto car = read_car(text, "car.yaml");
    return car ? car->params : throw std::runtime_error(to_string(car.error()));
  };
  const Reported before = read(parsed(av21()));
  std::size_t seen = 0;
  for (const Piece& number : numbers(av21())) {
    const std::string path = path_of(av21(), number);
    if (path.rfind(section + ".", 0) != 0 || path.find(".from_mps") != std::string::npos ||
        path.find(".at_mps") != std::string::npos)
      continue;
    ASSERT_TRUE(before.contains(path)) << path;
    const double value = std::stod(number.text);
    ASSERT_NEAR(before.at(path), value, 1e-9 * std::abs(value) + 1e-12) << path;
    ++seen;
    bool moved = false;
    for (const std::string& other : neighbours(number.text)) {
      const std::string changed = replaced(av21(), number, other);
      if (!refusal(changed).empty()) continue;
      const Reported after = read(parsed(changed));
      for (const auto& [name, was] : before)
        ASSERT_EQ(after.at(name) != was, name == path) << path << " moves " << name;
      ASSERT_NEAR(after.at(path), std::stod(other), 1e-9 * std::abs(value) + 1e-9) << path;
      moved = true;
      break;
    }
    EXPECT_TRUE(moved) << path << ": no neighbour of " << number.text << " is legal";
  }
  EXPECT_EQ(seen, before.size());
}

}  // namespace pitwall::parameters::testing
