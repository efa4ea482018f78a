// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/joystick_feed.hpp"

#include <fcntl.h>
#include <sys/eventfd.h>

#include <array>

#include "protocol/transport/readiness.hpp"

namespace pitwall::outlets {
namespace {

using transport::posix_call;

constexpr std::size_t kReadBytes = 24 * 64;
constexpr int kMaxReads = 16;  // a device that floods must not keep the loop

transport::PosixOutcome open_device(const std::string& path) {
  return posix_call([&] { return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); });
}

}  // namespace

Result<JoystickFeed, Problem> JoystickFeed::open(const std::string& path,
                                                 const intake::JoystickMapping& mapping) {
  const auto opened = open_device(path);
  if (!opened) return Unexpected{Problem{path, opened.reason()}};
  return JoystickFeed{path, transport::FileDescriptor{opened}, mapping};
}

JoystickFeed JoystickFeed::of(transport::FileDescriptor device,
                              const intake::JoystickMapping& mapping) {
  return JoystickFeed{{}, std::move(device), mapping};
}

Instant JoystickFeed::due() const { return present_ || path_.empty() ? Instant::max() : retry_at_; }

void JoystickFeed::serve(intake::Station& station, Instant now) {
  if (!present_) return look_again(now);
  std::array<std::uint8_t, kReadBytes> bytes;
  for (int i = 0; i < kMaxReads; ++i) {
    const auto got = transport::read_now(device_.get(), bytes);
    if (const auto sample = reports_.feed(std::span{bytes}.first(got.bytes))) {
      station.endpoint().joystick().sample(*sample, now);
      sampled_ = now;
      if (told_) told_(*sample, now);
    }
    if (got.ended) return lose(now);
    if (got.bytes < bytes.size()) return;
  }
}

void JoystickFeed::lose(Instant now) {
  present_ = false;
  reports_.forget();
  sampled_.reset();
  retry_at_ = now + kRetry;
  const transport::FileDescriptor silent{
      posix_call([] { return ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); })};
  posix_call([&] { return ::dup3(silent.get(), device_.get(), O_CLOEXEC); }).ok();
}

void JoystickFeed::look_again(Instant now) {
  if (path_.empty() || now < retry_at_) return;
  retry_at_ = now + kRetry;
  const transport::FileDescriptor device{open_device(path_)};
  if (!device.valid()) return;
  present_ = posix_call([&] { return ::dup3(device.get(), device_.get(), O_CLOEXEC); }).ok();
}

}  // namespace pitwall::outlets
