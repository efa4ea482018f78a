// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/message_log.hpp"

#include <utility>

namespace pitwall::service {

void MessageLog::pass(std::string_view type, std::string_view text, Instant at) const {
  for (const Sink& sink : sinks_) sink(type, text, at);
}

void MessageLog::set_state(std::string_view type, std::string text, Instant at) {
  pass(type, text, at);
  states_.insert_or_assign(std::string{type}, std::move(text));
}

void MessageLog::add_line(std::string_view type, std::string text, Instant at) {
  pass(type, text, at);
  std::deque<std::string>& log = lines_[std::string{type}];
  log.push_back(std::move(text));
  if (log.size() > kLines) log.pop_front();
}

void MessageLog::clear(std::string_view kept) {
  std::erase_if(states_, [kept](const auto& state) { return state.first != kept; });
  lines_.clear();
}

}  // namespace pitwall::service
