// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/clock_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <new>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::transport {
namespace {

struct flock whole_file(short kind) {
  struct flock lock {};
  lock.l_type = kind;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

Result<ClockMemory, Problem> ClockMemory::open(const std::string& path) {
  FileDescriptor file{posix_call(
      [&] { return ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600); })};
  if (!file.valid()) return Unexpected{Problem{path, "the file for bench time cannot be opened"}};
  struct stat status {};
  if (!posix_call([&] { return ::fstat(file.get(), &status); }).ok() || !S_ISREG(status.st_mode))
    return Unexpected{Problem{path, "expected a regular file for bench time"}};
  // A new file is zero bytes long; what is added to it reads as zero.
  if (status.st_size != 0 && status.st_size != static_cast<off_t>(sizeof(ClockPage)))
    return Unexpected{Problem{path, "is not a file of bench time"}};
  const auto grown = posix_call([&] { return ::ftruncate(file.get(), sizeof(ClockPage)); });
  if (!grown.ok()) return Unexpected{Problem{path, grown.reason()}};
  void* const mapped =
      ::mmap(nullptr, sizeof(ClockPage), PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (mapped == MAP_FAILED) return Unexpected{Problem{path, "cannot be mapped into memory"}};
  auto* const page = std::launder(static_cast<ClockPage*>(mapped));
  ClockMemory memory{std::move(file), page};
  std::uint64_t magic = 0;
  if (page->magic.load() == 0) {  // zero as its first user finds it: only the horizon is not
    std::int64_t none = 0;
    page->horizon_ns.compare_exchange_strong(none, INT64_MAX);
  }
  page->magic.compare_exchange_strong(magic, ClockPage::kMagic);
  if (magic != 0 && magic != ClockPage::kMagic)
    return Unexpected{Problem{path, "is not a file of bench time"}};
  return memory;
}

ClockMemory::~ClockMemory() {
  if (page_ != nullptr) ::munmap(page_, sizeof(ClockPage));
}

bool ClockMemory::lock() {
  auto wanted = whole_file(F_WRLCK);
  return posix_call([&] { return ::fcntl(file_.get(), F_OFD_SETLK, &wanted); }).ok();
}

bool ClockMemory::is_locked() const {
  auto asked = whole_file(F_WRLCK);
  const auto outcome = posix_call([&] { return ::fcntl(file_.get(), F_OFD_GETLK, &asked); });
  return outcome.ok() && asked.l_type != F_UNLCK;
}

void ClockMemory::unlock() {
  auto wanted = whole_file(F_UNLCK);
  CHECK(posix_call([&] { return ::fcntl(file_.get(), F_OFD_SETLK, &wanted); }).ok());
}

void ClockMemory::resume(Instant wall) {
  if (!lock()) return;  // another reader does it, or a new bench has come
  const std::int64_t horizon_ns = page_->horizon_ns.load();
  if (wall.ns - page_->lost_ns.load() > horizon_ns) page_->lost_ns.store(wall.ns - horizon_ns);
  page_->horizon_ns.store(INT64_MAX);
  unlock();
}

}  // namespace pitwall::transport
