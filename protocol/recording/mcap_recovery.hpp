// Recovery of an MCAP file whose writer died: index, statistics and footer are rewritten for every
// readable message.
//   in     the bytes of the file
//   out    the bytes of a whole file with the same channels, messages, stamps, sequences and
//          metadata, and what was kept and lost
//   invariants
//          messages keep their order; nothing is added. A whole file of ours gives a file with the
//          same messages
//          the CRC of a chunk that the end of the file cuts cannot be checked: those of its whole
//          messages are kept whose time is in the time range of the chunk
//   errors a file without the MCAP magic is refused. A chunk with a wrong CRC is lost as a whole;
//          after an inconsistent record everything is lost up to the next chunk in an intact
//          summary. Both are counted
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
  McapEnd found = McapEnd::kReading;  // end of the old file
  std::uint64_t kept = 0;             // messages
  std::uint64_t unverified = 0;       // of those, without a CRC that could be checked
  std::uint64_t chunks_lost = 0;      // wrong CRC, or compressed
  std::uint64_t messages_lost = 0;    // unknown channel, or impossible time
  std::uint64_t bytes_lost = 0;       // of inconsistent records, and after the last record
  bool checksum_wrong = false;        // the CRC of all data: some byte has changed
  Instant first{}, last{};            // of the messages kept

  // At most an index is missing.
  bool lossless() const { return chunks_lost + messages_lost + bytes_lost == 0 && !checksum_wrong; }
  bool was_whole() const { return found == McapEnd::kComplete && lossless(); }
};

Result<McapRecovery, Problem> recover_mcap(std::span<const std::uint8_t> file,
                                           const std::string& place);

// Example: "12 messages kept, ...".
std::string to_string(const McapRecovery& recovery);

}  // namespace pitwall::recording
