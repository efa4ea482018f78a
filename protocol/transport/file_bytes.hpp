// Bytes of a whole file of any length, or bytes in memory. A regular file is mapped and not copied,
// so that only the pages in use take memory; another file (a pipe) is read.
//   in     a path, or bytes
//   out    a view of the bytes, valid as long as any copy of the owner exists; writes to the
//          writable view go to private copies of the pages and never to the file
//   units  bytes
//   errors map(): Problem with the path as place. If a mapped file becomes shorter, the program
//          ends with a message and exit code 2, because the bytes no longer exist
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
  FileBytes(std::string bytes);  // NOLINT(google-explicit-constructor): equivalent to a file

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
