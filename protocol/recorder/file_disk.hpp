// Recording segments as files of one folder, on the disk within a second of being written.
//   in     the folder, which is created; names and bytes
//   out    files; each open one is locked, so that no other process takes it for an unfinished file
//          of a killed recorder
//   invariants
//          appending does not wait for the disk: a thread of its own syncs once a second. The
//          longest sync is reported
//   errors Problem with the path; failed syncs are counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "protocol/recorder/disk.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::recorder {

class FileDisk : public Disk {
 public:
  static constexpr Duration kSyncEvery = seconds(1);

  explicit FileDisk(std::string folder);
  ~FileDisk() override;

  // Checks that the folder exists and is writable.
  std::optional<Problem> check() const;
  std::optional<Problem> begin(const std::string& name) override;
  bool append(std::span<const std::uint8_t> bytes) override;
  void end(bool keep) override;
  std::string problem() const override;
  std::uint64_t free_bytes() const override;

  std::uint64_t syncs() const { return syncs_; }
  std::uint64_t failed_syncs() const { return failed_syncs_; }
  Duration longest_sync() const { return {longest_sync_ns_}; }

 private:
  void sync_now_and_then();
  void sync(int fd);

  std::string folder_, path_;
  std::optional<transport::AppendWriter> file_;
  std::atomic<std::uint64_t> syncs_ = 0, failed_syncs_ = 0;
  std::atomic<std::int64_t> longest_sync_ns_ = 0;
  std::mutex mutex_;
  std::condition_variable ends_;
  std::shared_ptr<transport::FileDescriptor> to_sync_;  // a second descriptor of the open file
  bool stop_ = false;
  std::thread syncer_;
};

// True if another process is writing this file now.
bool is_being_written(const std::string& path);

}  // namespace pitwall::recorder
