// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc/signal_name.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace pitwall::cli {
namespace {

constexpr std::size_t kNearest = 3;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

template <typename Named>
std::string nearest(const std::vector<Named>& all, std::string_view name,
                    const std::string& before) {
  std::vector<std::pair<std::size_t, std::string_view>> ranked;
  for (const Named& one : all) ranked.emplace_back(edit_distance(one.name, name), one.name);
  const std::size_t shown = std::min(kNearest, ranked.size());
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(shown),
                    ranked.end());
  std::string out;
  for (std::size_t i = 0; i < shown; ++i)
    out += (i == 0 ? "; the nearest: " : ", ") + before + std::string(ranked[i].second);
  return out;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[k]) ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({row[k] + 1, row[k + 1] + 1, replaced});
    }
  }
  return row.back();
}

Result<FoundSignal, Problem> find_signal(const can::Database& database, std::string_view words) {
  const std::string place(words);
  const std::size_t dot = words.find('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == words.size())
    return Unexpected{Problem{place, "expected MESSAGE.SIGNAL, as " + database.name + " has them"}};
  const std::string_view message_name = words.substr(0, dot), signal_name = words.substr(dot + 1);
  const can::Message* const message = database.find(message_name);
  if (message == nullptr)
    return Unexpected{Problem{place, database.name + " has no message \"" +
                                         std::string(message_name) + "\"" +
                                         nearest(database.messages, message_name, "")}};
  const can::Signal* const signal = message->find(signal_name);
  if (signal == nullptr)
    return Unexpected{
        Problem{place, message->name + " has no signal \"" + std::string(signal_name) + "\"" +
                           nearest(message->signals, signal_name, message->name + ".")}};
  return FoundSignal{message, signal};
}

}  // namespace pitwall::cli
