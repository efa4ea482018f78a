// Unauthenticated connections: new ones, and those that wait for another request. They are cheap to
// open for anybody, so they must not cost a place to who has a token.
//   in     a connection and the address it came from; that it was heard, that it went
//   out    which one must go for a new one: the one that was silent longest
//   bound  kPerAddress of one address, kInAll of all
//   cost   O(kInAll)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>

namespace pitwall::publishers::web {

class WaitingRoom {
 public:
  using Connection = std::uint64_t;
  static constexpr std::size_t kPerAddress = 64, kInAll = 128;

  std::optional<Connection> enter(Connection connection, std::uint32_t address);
  void receive(Connection connection);
  void leave(Connection connection);
  std::size_t size() const { return waiting_.size(); }

 private:
  struct Entry {
    Connection connection = 0;
    std::uint32_t address = 0;
  };
  std::list<Entry> waiting_;  // silent for longest first
};

}  // namespace pitwall::publishers::web
