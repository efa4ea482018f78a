// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/file_bytes.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <csignal>
#include <utility>

#include "protocol/transport/file.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::transport {
namespace {

constexpr int kErrors = 2, kExitUnusable = 2;

// Pages behind the new end of a file that was cut give this signal; nothing can be read from them.
void end_on_cut_file(int) {
  constexpr std::string_view kLine =
      "error: a file became shorter while it was read: copy it first, or wait until its recorder "
      "is done\n";
  static_cast<void>(::write(kErrors, kLine.data(), kLine.size()));
  ::_exit(kExitUnusable);
}

void watch_for_cut_files() {
  struct sigaction action {};
  action.sa_handler = end_on_cut_file;
  static_cast<void>(posix_call([&] { return ::sigaction(SIGBUS, &action, nullptr); }));
}

struct Unmap {
  std::size_t size = 0;
  void operator()(void* at) const { ::munmap(at, size); }
};

}  // namespace

FileBytes::FileBytes(std::string bytes) {
  const auto held = std::make_shared<std::string>(std::move(bytes));
  bytes_ = {held->data(), held->size()};
  owner_ = held;
}

std::span<const std::uint8_t> FileBytes::bytes() const { return as_bytes(text()); }

Result<FileBytes, Problem> FileBytes::map(const std::string& path) {
  struct stat about {};
  const auto asked = posix_call([&] { return ::stat(path.c_str(), &about); });
  if (!asked.ok()) return Unexpected{Problem{path, asked.reason()}};
  // A file of /proc has the size 0. A pipe is opened once only: its writer may be done by then.
  if (!S_ISREG(about.st_mode) || about.st_size == 0) {
    auto contents = read_file(path);
    if (!contents) return Unexpected{contents.error()};
    return FileBytes(*std::move(contents));
  }
  const auto opened = posix_call([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); });
  const FileDescriptor fd(opened);
  if (!fd.valid()) return Unexpected{Problem{path, opened.reason()}};
  // Of the file that is open now.
  const auto again = posix_call([&] { return ::fstat(fd.get(), &about); });
  if (!again.ok()) return Unexpected{Problem{path, again.reason()}};
  if (!S_ISREG(about.st_mode) || about.st_size == 0)
    return Unexpected{Problem{path, "was replaced while it was opened"}};
  const auto size = static_cast<std::size_t>(about.st_size);
  void* const at =
      ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE, fd.get(), 0);
  if (at == MAP_FAILED) return Unexpected{Problem{path, PosixOutcome{.error = errno}.reason()}};
  static_cast<void>(::madvise(at, size, MADV_SEQUENTIAL));
  watch_for_cut_files();
  return FileBytes(std::shared_ptr<void>(at, Unmap{size}), {static_cast<char*>(at), size});
}

}  // namespace pitwall::transport
