// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "protocol/transport/private_access.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::transport {
namespace {

constexpr std::size_t kReadBytes = 64 * 1024;

Unexpected<Problem> refuse(const std::string& path, const PosixOutcome& outcome) {
  return Unexpected{Problem{path, outcome.reason()}};
}

PosixOutcome open_file(const std::string& path, int flags, unsigned permissions = 0644) {
  return posix_call([&] { return ::open(path.c_str(), flags | O_CLOEXEC, permissions); });
}

PosixOutcome write_all(int fd, std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto rest = bytes.subspan(done);
    const auto out = posix_call([&] { return ::write(fd, rest.data(), rest.size()); });
    if (!out.ok()) return out;
    if (out.value == 0) return {.value = 0, .error = EIO};
    done += static_cast<std::size_t>(out.value);
  }
  return {.value = static_cast<std::int64_t>(done), .error = 0};
}

// To the end of an open file.
Result<std::string, Problem> read_all(const FileDescriptor& fd, const std::string& path,
                                      std::size_t max_bytes) {
  std::string contents;
  while (true) {  // a size asked beforehand would be 0 for /proc and old for a growing file
    const std::size_t before = contents.size();
    contents.resize(before + kReadBytes);
    const auto got =
        posix_call([&] { return ::read(fd.get(), contents.data() + before, kReadBytes); });
    if (!got.ok()) return refuse(path, got);
    contents.resize(before + static_cast<std::size_t>(got.value));
    if (got.value == 0) return contents;
    if (contents.size() > max_bytes)
      return Unexpected{Problem{path, "longer than " + std::to_string(max_bytes) + " bytes"}};
  }
}

}  // namespace

Result<std::string, Problem> read_file(const std::string& path, std::size_t max_bytes) {
  const auto opened = open_file(path, O_RDONLY);
  const FileDescriptor fd(opened);
  if (!fd.valid()) return refuse(path, opened);
  return read_all(fd, path, max_bytes);
}

Result<std::string, Problem> read_private_file(const std::string& path, std::size_t max_bytes) {
  const auto fd = open_private(path);
  if (!fd) return Unexpected{fd.error()};
  return read_all(*fd, path, max_bytes);
}

Result<bool, Problem> write_private_file(const std::string& path, std::string_view contents) {
  if (auto problem = check_folder_of(path)) return Unexpected{*std::move(problem)};
  const auto opened = open_file(path, O_WRONLY | O_CREAT | O_EXCL, kOwnerOnly);
  const FileDescriptor fd(opened);
  if (!fd.valid()) return refuse(path, opened);
  auto outcome = write_all(fd.get(), as_bytes(contents));
  if (outcome.ok()) outcome = posix_call([&] { return fsync(fd.get()); });
  if (outcome.ok()) return true;
  static_cast<void>(posix_call([&] { return unlink(path.c_str()); }));
  return refuse(path, outcome);
}

Result<bool, Problem> write_file(const std::string& path, std::string_view contents,
                                 unsigned permissions) {
  const std::string beside = path + ".part";
  const auto opened = open_file(beside, O_WRONLY | O_CREAT | O_TRUNC, permissions);
  const FileDescriptor fd(opened);
  if (!fd.valid()) return refuse(path, opened);
  auto outcome = write_all(fd.get(), as_bytes(contents));
  if (outcome.ok()) outcome = posix_call([&] { return fsync(fd.get()); });
  if (outcome.ok()) outcome = posix_call([&] { return rename(beside.c_str(), path.c_str()); });
  if (outcome.ok()) return true;
  static_cast<void>(posix_call([&] { return unlink(beside.c_str()); }));
  return refuse(path, outcome);
}

bool write_to(int descriptor, std::string_view text) {
  return write_all(descriptor, as_bytes(text)).ok();
}

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

Result<AppendWriter, Problem> AppendWriter::open(const std::string& path, Start start) {
  const int truncate = start == Start::kTruncate ? O_TRUNC : 0;
  const auto opened = open_file(path, O_WRONLY | O_CREAT | O_APPEND | truncate);
  FileDescriptor fd(opened);
  if (!fd.valid()) return refuse(path, opened);
  struct stat about {};
  const auto asked = posix_call([&] { return fstat(fd.get(), &about); });
  if (!asked.ok()) return refuse(path, asked);
  return AppendWriter(std::move(fd), about.st_size);
}

bool AppendWriter::write(std::span<const std::uint8_t> bytes) {
  const auto outcome = write_all(fd_.get(), bytes);
  if (outcome.ok()) {
    length_ += outcome.value;
    counters_.bytes += bytes.size();
    ++counters_.writes;
    return true;
  }
  ++counters_.failures;
  counters_.last_error = outcome.error;
  static_cast<void>(posix_call([&] { return ftruncate(fd_.get(), length_); }));
  return false;
}

bool AppendWriter::write(std::string_view text) { return write(as_bytes(text)); }

bool AppendWriter::sync() {
  const auto outcome = posix_call([&] { return fdatasync(fd_.get()); });
  if (outcome.ok()) {
    ++counters_.syncs;
    return true;
  }
  ++counters_.failures;
  counters_.last_error = outcome.error;
  return false;
}

Result<TemporaryFolder, Problem> TemporaryFolder::create(std::string_view prefix,
                                                         std::string parent) {
  const char* chosen = std::getenv("TMPDIR");
  if (parent.empty()) parent = chosen != nullptr && *chosen != '\0' ? chosen : "/tmp";
  std::string path = parent + "/" + std::string(prefix) + "XXXXXX";
  const auto made = posix_call([&] { return mkdtemp(path.data()) == nullptr ? -1 : 0; });
  if (!made.ok()) return refuse(parent, made);
  return TemporaryFolder(std::move(path));
}

TemporaryFolder::~TemporaryFolder() {
  if (path_.empty()) return;
  std::error_code ignored;  // what cannot be removed is the system's to clean up
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace pitwall::transport
