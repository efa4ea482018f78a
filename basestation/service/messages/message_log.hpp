// Messages of one car's service as JSON texts: the newest message of each state type, and the last
// lines of each log. Consoles, the recorder and other tools all get the same ones.
//   in     texts with their type and time
//   out    each message at once to every subscriber; for a client that connects later, the kept
//          states and lines
//   bound  the last kLines of each log are kept
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::service {

class MessageLog {
 public:
  static constexpr std::size_t kLines = 200;
  using Sink = std::function<void(std::string_view type, std::string_view text, Instant at)>;

  // The sink must outlive the log.
  void subscribe(Sink sink) { sinks_.push_back(std::move(sink)); }

  // Replaces the newest text of this type.
  void set_state(std::string_view type, std::string text, Instant at);
  void add_line(std::string_view type, std::string text, Instant at);
  // Gives the text to the subscribers without keeping it.
  void pass(std::string_view type, std::string_view text, Instant at) const;
  // Forgets all but the state of this type.
  void clear(std::string_view kept = {});

  const std::map<std::string, std::string, std::less<>>& states() const { return states_; }
  const std::map<std::string, std::deque<std::string>, std::less<>>& lines() const {
    return lines_;
  }

 private:
  std::map<std::string, std::string, std::less<>> states_;
  std::map<std::string, std::deque<std::string>, std::less<>> lines_;
  std::vector<Sink> sinks_;
};

}  // namespace pitwall::service
