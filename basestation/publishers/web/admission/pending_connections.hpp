// Unauthenticated connections: new ones, and those that wait for another request. Anybody can open
// them cheaply, so they must not take the places of clients with a token.
//   in     connections with their source addresses; when one sends data or ends
//   out    the connection to close for a new one: the one that was silent longest
//   bound  kPerAddress from one address, kInAll in total
//   cost   O(kInAll)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>

namespace pitwall::publishers::web {

class PendingConnections {
 public:
  using Connection = std::uint64_t;
  static constexpr std::size_t kPerAddress = 64, kInAll = 128;

  std::optional<Connection> add(Connection connection, std::uint32_t address);
  void receive(Connection connection);
  void leave(Connection connection);
  std::size_t size() const { return waiting_.size(); }

 private:
  struct Entry {
    Connection connection = 0;
    std::uint32_t address = 0;
  };
  std::list<Entry> waiting_;  // longest silent first
};

}  // namespace pitwall::publishers::web
