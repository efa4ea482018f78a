// SPDX-License-Identifier: Apache-2.0
#include "tests/system/slcan/scripted_controller.hpp"

#include <linux/if.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <array>
#include <utility>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::slcan {
namespace {

constexpr int kSlcanDiscipline = 17;  // N_SLCAN
constexpr Duration kPause = milliseconds(1);
// The driver calls the controller active only after its "open" has left; what is said earlier is
// forgotten.
constexpr Duration kAnswerAfter = milliseconds(20);

using transport::FileDescriptor;
using transport::posix_call;

}  // namespace

Result<std::unique_ptr<ScriptedController>, Problem> ScriptedController::open() {
  const auto refuse = [](const char* what, const transport::PosixOutcome& outcome) {
    return Unexpected{Problem{"slcan", std::string(what) + ": " + outcome.reason()}};
  };
  int master = -1, line = -1;
  const auto made = posix_call([&] { return openpty(&master, &line, nullptr, nullptr, nullptr); });
  if (!made.ok()) return refuse("no pseudo-terminal", made);
  FileDescriptor master_end(master), line_end(line);
  termios mode{};
  static_cast<void>(posix_call([&] { return tcgetattr(line, &mode); }));
  cfmakeraw(&mode);
  const auto raw = posix_call([&] { return tcsetattr(line, TCSANOW, &mode); });
  if (!raw.ok()) return refuse("raw mode", raw);
  const auto set = posix_call([&] { return ioctl(line, TIOCSETD, &kSlcanDiscipline); });
  if (!set.ok()) return refuse("line discipline (root and the module slcan are needed)", set);
  ifreq named{};
  const auto got = posix_call([&] { return ioctl(line, SIOCGIFNAME, &named); });
  if (!got.ok()) return refuse("interface name", got);
  return std::unique_ptr<ScriptedController>(
      new ScriptedController(std::move(master_end), std::move(line_end), named.ifr_name));
}

ScriptedController::ScriptedController(FileDescriptor master, FileDescriptor line,
                                       std::string interface)
    : master_(std::move(master)),
      line_(std::move(line)),
      interface_(std::move(interface)),
      thread_([this] { serve(); }) {}

ScriptedController::~ScriptedController() { unplug(); }

// The thread listens until the interface is gone: closing sends a command, which must leave.
void ScriptedController::unplug() {
  if (!thread_.joinable()) return;
  listen(true);
  line_.reset();
  end_.store(true);
  thread_.join();
  master_.reset();
}

void ScriptedController::say(std::string_view words) {
  static_cast<void>(posix_call([&] { return ::write(master_.get(), words.data(), words.size()); }));
}

void ScriptedController::answer_open(std::string words) {
  const std::lock_guard guard(lock_);
  answer_ = std::move(words);
}

std::vector<std::string> ScriptedController::take_frames() {
  const std::lock_guard guard(lock_);
  return std::exchange(frames_, {});
}

void ScriptedController::listen(bool on) {
  const std::lock_guard guard(reading_);
  listening_ = on;
}

void ScriptedController::serve() {
  while (!end_.load()) {
    answer_when_due();
    const int watched[] = {master_.get()};
    const bool any = transport::wait_readable(watched, transport::monotonic_now() + kPause) != 0;
    if (!any || !read_some()) transport::sleep_until(transport::monotonic_now() + kPause);
  }
}

void ScriptedController::answer_when_due() {
  const std::lock_guard guard(lock_);
  if (!answer_at_ || transport::monotonic_now() < *answer_at_) return;
  answer_at_.reset();
  say(answer_);
}

bool ScriptedController::read_some() {
  const std::lock_guard guard(reading_);
  if (!listening_) return false;
  std::array<std::uint8_t, 1'024> bytes;
  const auto got = transport::read_available(master_.get(), bytes);
  for (std::size_t i = 0; i < got.bytes; ++i) {
    if (bytes[i] == '\r')
      take(std::exchange(part_, {}));
    else
      part_ += static_cast<char>(bytes[i]);
  }
  return got.bytes > 0;
}

void ScriptedController::take(std::string line) {
  if (line.empty()) return;
  const std::lock_guard guard(lock_);
  const char command = line[0];
  if (command == 't') frames_.push_back(std::move(line));
  if (command != 'O' && command != 'L') return;
  ++opened_;
  answer_at_ = transport::monotonic_now() + kAnswerAfter;
}

}  // namespace pitwall::slcan
