// Whole files in, checked appends out, and folders that vanish.
//   in     paths, bytes
//   out    contents; counters of what reached the disk
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
// Replaces the whole file: written beside it, flushed, then renamed, so no reader sees half of it.
Result<bool, Problem> write_file(const std::string& path, std::string_view contents,
                                 unsigned permissions = 0644);

// A file that holds a secret: refused if others may read, change or replace it, see
// private_access.hpp.
Result<std::string, Problem> read_private_file(const std::string& path,
                                               std::size_t max_bytes = kMaxFileBytes);
// A new one, for its owner only; refused where it exists already or others may replace it.
Result<bool, Problem> write_private_file(const std::string& path, std::string_view contents);

// The whole text to an open descriptor (1 and 2 are standard output and errors).
bool write_to(int descriptor, std::string_view text);
bool is_terminal(int descriptor);

struct AppendCounters {
  std::uint64_t bytes = 0, writes = 0, syncs = 0;
  std::uint64_t failures = 0;  // write() or sync() that did not succeed completely
  int last_error = 0;          // errno of the last failure
};

// Appends; every write is checked. A failed write leaves the file at the length it had before
// where the disk allows it, so that a log has no half records.
class AppendWriter {
 public:
  enum class Start : std::uint8_t { kAppend, kTruncate };
  static Result<AppendWriter, Problem> open(const std::string& path, Start start = Start::kAppend);

  bool write(std::span<const std::uint8_t> bytes);
  bool write(std::string_view text);
  bool sync();  // fdatasync: on the disk, not only in memory
  const AppendCounters& counters() const { return counters_; }
  int fd() const { return fd_.get(); }

 private:
  AppendWriter(FileDescriptor fd, std::int64_t length) : fd_(std::move(fd)), length_(length) {}

  FileDescriptor fd_;
  std::int64_t length_ = 0;
  AppendCounters counters_;
};

// A new private folder in `parent`, or in $TMPDIR or /tmp; removed with all it holds at the end of
// its life.
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
