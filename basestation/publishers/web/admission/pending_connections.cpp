// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/pending_connections.hpp"

#include <algorithm>

namespace pitwall::publishers::web {

std::optional<PendingConnections::Connection> PendingConnections::add(Connection connection,
                                                                      std::uint32_t address) {
  const auto of_address = [&](const Entry& entry) { return entry.address == address; };
  const auto of_it = static_cast<std::size_t>(std::ranges::count_if(waiting_, of_address));
  auto goes = waiting_.end();
  if (of_it >= kPerAddress) {
    goes = std::ranges::find_if(waiting_, of_address);
  } else if (waiting_.size() >= kInAll) {
    goes = waiting_.begin();
  }
  std::optional<Connection> gone;
  if (goes != waiting_.end()) {
    gone = goes->connection;
    waiting_.erase(goes);
  }
  waiting_.push_back({.connection = connection, .address = address});
  return gone;
}

void PendingConnections::receive(Connection connection) {
  const auto found = std::ranges::find(waiting_, connection, &Entry::connection);
  if (found != waiting_.end()) waiting_.splice(waiting_.end(), waiting_, found);
}

void PendingConnections::leave(Connection connection) {
  waiting_.remove_if([&](const Entry& entry) { return entry.connection == connection; });
}

}  // namespace pitwall::publishers::web
