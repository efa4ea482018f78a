// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/shared_stop.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <array>
#include <atomic>
#include <cstring>
#include <span>
#include <utility>

#include "protocol/bits/crc.hpp"
#include "protocol/transport/posix_call.hpp"

namespace pitwall::io {
namespace {

using transport::FileDescriptor;
using transport::posix_call;

constexpr std::uint32_t kMagic = 0x53474450;  // "PDGS"
constexpr std::uint32_t kVersion = 1;         // of the layout: raised when a value changes

// One copy. The bytes are what the CRC is over, padding included.
template <class Value>
struct Copy {
  std::uint64_t sequence = 0;  // 0: never written
  std::array<std::uint8_t, sizeof(Value)> bytes{};
  std::uint32_t crc = 0;
};

template <class Value>
std::uint32_t crc_of(const Copy<Value>& copy) {
  std::array<std::uint8_t, sizeof copy.sequence> sequence{};
  std::memcpy(sequence.data(), &copy.sequence, sizeof copy.sequence);
  return bits::crc32_ieee(copy.bytes, bits::crc32_ieee(sequence));
}

template <class Value>
struct Pair {
  std::uint64_t newest = 0;  // sequence of the copy that was finished last; a hint for readers
  std::array<Copy<Value>, 2> copies;
};

std::size_t place_of(std::uint64_t sequence) { return static_cast<std::size_t>(sequence % 2); }

// The order in which another process sees this: all of the copy before the hint.
void fence() { std::atomic_thread_fence(std::memory_order_seq_cst); }

template <class Value>
bool read_copy(const Copy<Value>& shared, Copy<Value>& own) {
  fence();
  std::memcpy(&own, &shared, sizeof own);
  fence();
  return own.sequence != 0 && crc_of(own) == own.crc;
}

// The newest whole copy: the hinted one, else the newer of those that are whole.
template <class Value>
bool read_newest(const Pair<Value>& pair, Copy<Value>& own) {
  const std::uint64_t hint = pair.newest;
  if (read_copy(pair.copies[place_of(hint)], own) && own.sequence >= hint) return true;
  Copy<Value> other;
  const bool first = read_copy(pair.copies[0], own), second = read_copy(pair.copies[1], other);
  if (second && (!first || other.sequence > own.sequence)) own = other;
  return first || second;
}

template <class Value>
bool read_value(const Pair<Value>& pair, Value& value) {
  Copy<Value> own;
  if (!read_newest(pair, own)) return false;
  std::memcpy(&value, own.bytes.data(), sizeof value);
  return true;
}

template <class Value>
void write_value(Pair<Value>& pair, const Value& value) {
  const std::uint64_t sequence = pair.newest + 1;
  Copy<Value> own;
  own.sequence = sequence;
  std::memcpy(own.bytes.data(), &value, sizeof value);
  own.crc = crc_of(own);
  fence();
  std::memcpy(&pair.copies[place_of(sequence)], &own, sizeof own);
  fence();
  pair.newest = sequence;
  fence();
}

// A writer that was killed between copy and hint has left a copy newer than the hint.
template <class Value>
void restore_newest(Pair<Value>& pair) {
  Copy<Value> own;
  if (read_newest(pair, own) && own.sequence > pair.newest) pair.newest = own.sequence;
}

}  // namespace

struct SharedStop::Layout {
  std::uint32_t magic, version, record_bytes, status_bytes;
  Pair<guardian::CarRecord> record;
  Pair<guardian::Status> status;
};

std::string shared_stop_path(std::string_view name) {
  const bool path = name.find('/') != std::string_view::npos;
  return path ? std::string(name) : "/dev/shm/" + std::string(name);
}

Result<SharedStop, Problem> SharedStop::open(std::string_view name) {
  const std::string path = shared_stop_path(name);
  constexpr auto kBytes = static_cast<off_t>(sizeof(Layout));
  constexpr mode_t kOwnerOnly = S_IRUSR | S_IWUSR;
  const auto opened =
      posix_call([&] { return ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kOwnerOnly); });
  if (!opened) return refuse(path, opened.reason());
  const FileDescriptor file{opened};
  struct stat status {};
  if (const auto known = posix_call([&] { return ::fstat(file.get(), &status); }); !known)
    return refuse(path, known.reason());
  const bool fresh = status.st_size == 0;
  if (!fresh && status.st_size != kBytes)
    return refuse(path, "holds a record of another layout: car and guardian must be of one build");
  if (fresh)
    if (const auto sized = posix_call([&] { return ::ftruncate(file.get(), kBytes); }); !sized)
      return refuse(path, sized.reason());
  void* memory = ::mmap(nullptr, sizeof(Layout), PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (memory == MAP_FAILED) return refuse(path, std::strerror(errno));
  auto* layout = static_cast<Layout*>(memory);
  // Both may come at once: they write the same.
  if (layout->magic == 0) {
    layout->version = kVersion;
    layout->record_bytes = sizeof(guardian::CarRecord);
    layout->status_bytes = sizeof(guardian::Status);
    fence();
    layout->magic = kMagic;
  }
  SharedStop shared{layout};
  if (layout->magic != kMagic || layout->version != kVersion ||
      layout->record_bytes != sizeof(guardian::CarRecord) ||
      layout->status_bytes != sizeof(guardian::Status))
    return refuse(path, "holds a record of another layout: car and guardian must be of one build");
  restore_newest(layout->record);
  restore_newest(layout->status);
  return shared;
}

SharedStop::SharedStop(SharedStop&& other) noexcept
    : layout_(std::exchange(other.layout_, nullptr)) {}

SharedStop::~SharedStop() {
  if (layout_) ::munmap(layout_, sizeof(Layout));
}

void SharedStop::write(const guardian::CarRecord& record) { write_value(layout_->record, record); }
void SharedStop::write(const guardian::Status& status) { write_value(layout_->status, status); }
bool SharedStop::read(guardian::CarRecord& record) const {
  return read_value(layout_->record, record);
}
bool SharedStop::read(guardian::Status& status) const {
  return read_value(layout_->status, status);
}

}  // namespace pitwall::io
