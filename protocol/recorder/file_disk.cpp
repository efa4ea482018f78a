// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/file_disk.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "protocol/transport/clock.hpp"

namespace pitwall::recorder {

using transport::posix_call;

FileDisk::FileDisk(std::string folder)
    : folder_(std::move(folder)), syncer_([this] { sync_now_and_then(); }) {}

FileDisk::~FileDisk() {
  end(true);
  {
    const std::lock_guard lock{mutex_};
    stop_ = true;
  }
  ends_.notify_one();
  syncer_.join();
}

std::optional<Problem> FileDisk::check() const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) return Problem{folder_, error.message()};
  const auto out = posix_call([&] { return ::access(folder_.c_str(), W_OK | X_OK); });
  if (!out) return Problem{folder_, out.reason()};
  return std::nullopt;
}

std::optional<Problem> FileDisk::begin(const std::string& name) {
  path_ = folder_ + "/" + name;
  auto opened = transport::AppendWriter::open(path_, transport::AppendWriter::Start::kTruncate);
  if (!opened) return opened.error();
  file_.emplace(*std::move(opened));
  const auto locked = posix_call([&] { return ::flock(file_->fd(), LOCK_EX | LOCK_NB); });
  if (!locked) {
    file_.reset();
    return Problem{path_, locked.reason()};
  }
  const auto second = posix_call([&] { return ::fcntl(file_->fd(), F_DUPFD_CLOEXEC, 0); });
  const transport::FileDescriptor parent{
      posix_call([&] { return ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); })};
  if (parent.valid()) sync(parent.get());  // the name, too, outlives a loss of power
  const std::lock_guard lock{mutex_};
  to_sync_ = std::make_shared<transport::FileDescriptor>(second);
  return std::nullopt;
}

bool FileDisk::append(std::span<const std::uint8_t> bytes) { return file_ && file_->write(bytes); }

void FileDisk::end(bool keep) {
  if (!file_) return;
  std::shared_ptr<transport::FileDescriptor> last;
  {
    const std::lock_guard lock{mutex_};
    last = std::exchange(to_sync_, nullptr);
  }
  if (keep && last) sync(last->get());
  if (!keep) posix_call([&] { return ::unlink(path_.c_str()); }).ok();
  // Of two descriptors of one file either holds the lock.
  posix_call([&] { return ::flock(file_->fd(), LOCK_UN); }).ok();
  file_.reset();
}

std::string FileDisk::problem() const {
  return path_ + ": error: " + (file_ ? std::strerror(file_->counters().last_error) : "not open");
}

std::uint64_t FileDisk::free_bytes() const {
  struct statvfs status {};
  const auto out = posix_call([&] { return ::statvfs(folder_.c_str(), &status); });
  return out ? std::uint64_t{status.f_bavail} * status.f_frsize : 0;
}

void FileDisk::sync_now_and_then() {
  std::unique_lock lock{mutex_};
  while (!stop_) {
    ends_.wait_for(lock, std::chrono::nanoseconds{kSyncEvery.ns}, [this] { return stop_; });
    const auto held = to_sync_;
    if (!held || stop_) continue;
    lock.unlock();
    sync(held->get());
    lock.lock();
  }
}

void FileDisk::sync(int fd) {
  const Instant begun = transport::monotonic_now();
  const auto out = posix_call([&] { return ::fdatasync(fd); });
  ++(out ? syncs_ : failed_syncs_);
  const Duration took = transport::monotonic_now() - begun;
  longest_sync_ns_ = std::max(longest_sync_ns_.load(), took.ns);
}

bool is_being_written(const std::string& path) {
  const transport::FileDescriptor fd{
      posix_call([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); })};
  if (!fd.valid()) return false;
  return !posix_call([&] { return ::flock(fd.get(), LOCK_SH | LOCK_NB); }).ok();
}

}  // namespace pitwall::recorder
