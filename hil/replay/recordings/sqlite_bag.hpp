// Bags of ROS 2 in SQLite (.db3, rosbag2's storage until Humble).
//   in     the whole file; its name for remarks
//   out    a source for each topic, as mcap_recording.hpp has them; messages in the order in which
//          they were written. Messages that rosbag2 compressed one by one (Zstandard) are
//          decompressed
//   units  stamps: the column `timestamp`, nanoseconds since 1970
//   errors Problem for what is no bag: no SQLite, or without the tables `topics` and `messages`.
//          Of a damaged or cut file what can be read is read; messages that cannot are told by
//          their id, which is what such a file has instead of an offset. A bag that was written
//          with a write-ahead log may have its last messages in the file FILE-wal: told
//   cost   O(bytes); messages are copied once. Nothing is written anywhere
//   source rosbag2_storage_sqlite3, sqlite_storage.cpp; https://sqlite.org/fileformat2.html
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/recordings/recording.hpp"
#include "protocol/transport/file_bytes.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::traffic {

bool is_sqlite(Bytes file);
Result<Recording, Problem> read_sqlite_bag(transport::FileBytes file, const std::string& name);

}  // namespace pitwall::traffic
