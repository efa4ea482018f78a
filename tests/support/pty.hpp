// Pseudo-terminal as a serial device for tests; the test holds the other end.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::support {

class Pty {
 public:
  Pty() : master_(transport::posix_call([] { return posix_openpt(O_RDWR | O_NOCTTY); })) {
    EXPECT_EQ(grantpt(master_.get()), 0);
    EXPECT_EQ(unlockpt(master_.get()), 0);
  }
  std::string path() const { return ptsname(master_.get()); }
  void say(std::span<const std::uint8_t> bytes) const {
    EXPECT_EQ(::write(master_.get(), bytes.data(), bytes.size()), std::ssize(bytes));
  }
  void say(std::string_view text) const {
    say({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  // Reads what the program under test has written, without waiting.
  std::size_t read(std::span<std::uint8_t> into) const {
    return transport::read_available(master_.get(), into).bytes;
  }

 private:
  transport::FileDescriptor master_;
};

}  // namespace pitwall::support
