// Recovery of an MCAP file whose writer died: index, statistics and footer are written anew for
// every message that can be read.
//   in     the bytes that there are
//   out    the bytes of a whole file with the same channels, messages, stamps, sequences and
//          metadata, and what was kept and lost
//   invariants
//          messages keep their order; nothing is invented. A whole file of ours gives a file with
//          the same messages
//          the chunk that a cut goes through has no CRC that could be checked: of its whole
//          messages those are kept that lie in the time that the chunk names
//   errors what does not begin as an MCAP file is refused. A chunk with a wrong CRC is lost as a
//          whole; behind a record that contradicts itself everything is lost up to the next chunk
//          that an intact summary names. Both are counted
//   cost   O(bytes); holds the new file in memory
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/recording/mcap_reader.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::recording {

struct McapRecovery {
  std::vector<std::uint8_t> file;
  McapEnd found = McapEnd::kReading;  // how the old file ends
  std::uint64_t kept = 0;             // messages
  std::uint64_t unverified = 0;       // of those, without a CRC that could be checked
  std::uint64_t chunks_lost = 0;      // wrong CRC, or compressed
  std::uint64_t messages_lost = 0;    // of no known channel, or at impossible times
  std::uint64_t bytes_lost = 0;       // of records that contradict themselves, and behind the last
  bool checksum_wrong = false;        // of all data: something is not as it was written
  Instant first{}, last{};            // of the messages kept

  // Nothing but an index is missing, or not even that.
  bool lossless() const { return chunks_lost + messages_lost + bytes_lost == 0 && !checksum_wrong; }
  bool was_whole() const { return found == McapEnd::kComplete && lossless(); }
};

Result<McapRecovery, Problem> recover_mcap(std::span<const std::uint8_t> file,
                                           const std::string& place);

// "12 messages kept, ..." for a person.
std::string to_string(const McapRecovery& recovery);

}  // namespace pitwall::recording
