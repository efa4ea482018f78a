// Reader of ROS 2 bags in SQLite (.db3, the default storage of rosbag2 until Humble).
//   in     the whole file; its name for remarks
//   out    one source per topic, as in mcap_recording.hpp; messages in the order in which they were
//          written. Messages that rosbag2 compressed one by one (Zstandard) are decompressed
//   units  stamps: the column `timestamp`, nanoseconds since 1970
//   errors Problem for a file that is not a bag: not SQLite, or without the tables `topics` and
//          `messages`. From a damaged or cut file all readable messages are taken; each unreadable
//          one gets a remark with its id, because such a file has no offsets. A bag that was
//          written with a write-ahead log may have its last messages in the file FILE-wal: this
//          gets a remark
//   cost   O(bytes); messages are copied once. No file is written
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
