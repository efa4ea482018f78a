// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/joystick_device.hpp"

#include <fcntl.h>
#include <sys/eventfd.h>

#include <array>

#include "protocol/transport/readiness.hpp"

namespace pitwall::inputs {
namespace {

using transport::posix_call;

constexpr std::size_t kReadBytes = 24 * 64;
constexpr int kMaxReads = 16;  // a device that floods must not keep the loop

transport::PosixOutcome open_device(const std::string& path) {
  return posix_call([&] { return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); });
}

}  // namespace

Result<JoystickDevice, Problem> JoystickDevice::open(const std::string& path,
                                                     const JoystickMapping& mapping) {
  const auto opened = open_device(path);
  if (!opened) return Unexpected{Problem{path, opened.reason()}};
  return JoystickDevice{path, transport::FileDescriptor{opened}, mapping};
}

JoystickDevice JoystickDevice::of(transport::FileDescriptor device,
                                  const JoystickMapping& mapping) {
  return JoystickDevice{{}, std::move(device), mapping};
}

Instant JoystickDevice::due() const {
  return present_ || path_.empty() ? Instant::max() : retry_at_;
}

void JoystickDevice::read(Instant now, const Sink& sink) {
  if (!present_) return reopen(now);
  std::array<std::uint8_t, kReadBytes> bytes;
  for (int i = 0; i < kMaxReads; ++i) {
    const auto got = transport::read_now(device_.get(), bytes);
    if (const auto sample = reports_.feed(std::span{bytes}.first(got.bytes))) {
      sampled_ = now;
      sink(*sample, now);
    }
    if (got.ended) return lose(now);
    if (got.bytes < bytes.size()) return;
  }
}

void JoystickDevice::lose(Instant now) {
  present_ = false;
  reports_.forget();
  sampled_.reset();
  retry_at_ = now + kRetry;
  const transport::FileDescriptor silent{
      posix_call([] { return ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); })};
  posix_call([&] { return ::dup3(silent.get(), device_.get(), O_CLOEXEC); }).ok();
}

void JoystickDevice::reopen(Instant now) {
  if (path_.empty() || now < retry_at_) return;
  retry_at_ = now + kRetry;
  const transport::FileDescriptor device{open_device(path_)};
  if (!device.valid()) return;
  present_ = posix_call([&] { return ::dup3(device.get(), device_.get(), O_CLOEXEC); }).ok();
}

}  // namespace pitwall::inputs
