// The bytes of a whole file, however long it is: a regular file is mapped and not copied, so that
// the kernel holds of it what is in use; anything else (a pipe) is read. Or bytes made in memory.
//   in     a path, or bytes
//   out    a view of the bytes, valid as long as any copy of the owner lives; the writable one is
//          a private copy of the pages that are written, the file never changes
//   units  bytes
//   errors map(): Problem with the path as place. A file that becomes shorter while it is mapped
//          ends the program with a line that says so and exit code 2: what was read is gone
//   cost   copies share the bytes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

class FileBytes {
 public:
  static Result<FileBytes, Problem> map(const std::string& path);
  FileBytes(std::string bytes);  // NOLINT(google-explicit-constructor): as good as a file

  std::string_view text() const { return {bytes_.data(), bytes_.size()}; }
  std::span<const std::uint8_t> bytes() const;
  std::span<char> writable() const { return bytes_; }
  std::shared_ptr<const void> owner() const { return owner_; }

 private:
  FileBytes(std::shared_ptr<void> owner, std::span<char> bytes)
      : owner_(std::move(owner)), bytes_(bytes) {}

  std::shared_ptr<void> owner_;
  std::span<char> bytes_;
};

}  // namespace pitwall::transport
