// File access: reading and writing of whole files, checked appends, temporary folders.
//   in     paths, bytes
//   out    contents; counters of written and synced bytes
//   units  bytes
//   errors Problem with the path as place; AppendWriter counts failures and keeps the last reason
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;

Result<std::string, Problem> read_file(const std::string& path,
                                       std::size_t max_bytes = kMaxFileBytes);
// Replaces the whole file: it is written under another name, flushed, then renamed, so that no
// reader sees a part of it.
Result<bool, Problem> write_file(const std::string& path, std::string_view contents,
                                 unsigned permissions = 0644);

// Reads a file with a secret; refused if others may read, change or replace it, see
// private_access.hpp.
Result<std::string, Problem> read_private_file(const std::string& path,
                                               std::size_t max_bytes = kMaxFileBytes);
// Writes a new file, for its owner only; refused if it exists already or others may replace it.
Result<bool, Problem> write_private_file(const std::string& path, std::string_view contents);

// Writes the whole text to an open descriptor (1 is standard output, 2 is standard error).
bool write_to(int descriptor, std::string_view text);
bool is_terminal(int descriptor);

struct AppendCounters {
  std::uint64_t bytes = 0, writes = 0, syncs = 0;
  std::uint64_t failures = 0;  // calls of write() or sync() that failed or were incomplete
  int last_error = 0;          // errno of the last failure
};

// Writer that appends to a file and checks every write. After a failed write the file is truncated
// to its former length if the disk allows it, so that a log has no partial records.
class AppendWriter {
 public:
  enum class Start : std::uint8_t { kAppend, kTruncate };
  static Result<AppendWriter, Problem> open(const std::string& path, Start start = Start::kAppend);

  bool write(std::span<const std::uint8_t> bytes);
  bool write(std::string_view text);
  bool sync();  // fdatasync: the data is on the disk, not only in memory
  const AppendCounters& counters() const { return counters_; }
  int fd() const { return fd_.get(); }

 private:
  AppendWriter(FileDescriptor fd, std::int64_t length) : fd_(std::move(fd)), length_(length) {}

  FileDescriptor fd_;
  std::int64_t length_ = 0;
  AppendCounters counters_;
};

// New private folder in `parent`, or in $TMPDIR or /tmp; the destructor removes it with its
// contents.
class TemporaryFolder {
 public:
  static Result<TemporaryFolder, Problem> create(std::string_view prefix, std::string parent = {});
  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();

  const std::string& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::string path) : path_(std::move(path)) {}
  std::string path_;
};

}  // namespace pitwall::transport
