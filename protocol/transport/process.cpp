// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <string_view>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/vocabulary/check.hpp"

extern char** environ;

namespace pitwall::transport {
namespace {

constexpr int kCannotExec = 127;  // as shells say it

// Everything the child needs, allocated before fork: between fork and exec only async-signal-safe
// calls are allowed.
struct Launch {
  std::vector<std::string> environment;
  std::vector<char*> argv, envp;
  const ProcessPlan& plan;
  int report_fd;
  pid_t parent;
};

std::string_view name_of(std::string_view assignment) {
  return assignment.substr(0, assignment.find('='));
}

std::vector<std::string> merged_environment(const std::vector<std::string>& additions) {
  std::vector<std::string> out = additions;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const bool replaced = std::any_of(additions.begin(), additions.end(),
                                      [&](const auto& a) { return name_of(a) == name_of(*entry); });
    if (!replaced) out.emplace_back(*entry);
  }
  return out;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> out;
  for (std::string& s : strings) out.push_back(s.data());
  out.push_back(nullptr);
  return out;
}

// Moves the sources above every target first, so that no dup2 overwrites one still needed.
bool map_descriptors(const std::vector<DescriptorMapping>& mappings) {
  int above = STDERR_FILENO;
  for (const auto& m : mappings) above = std::max({above, m.ours, m.theirs});
  std::array<int, 16> moved{};
  if (mappings.size() > moved.size()) return false;
  for (std::size_t i = 0; i < mappings.size(); ++i) {
    moved[i] = fcntl(mappings[i].ours, F_DUPFD_CLOEXEC, above + 1);
    if (moved[i] < 0) return false;
  }
  for (std::size_t i = 0; i < mappings.size(); ++i)
    if (dup2(moved[i], mappings[i].theirs) < 0) return false;
  return true;
}

// Descriptors that somebody opened without O_CLOEXEC; the mapped ones stay.
void close_others(const std::vector<DescriptorMapping>& mappings, int report_fd) {
  constexpr int kHighest = 1'024;  // the usual soft limit
  for (int fd = STDERR_FILENO + 1; fd < kHighest; ++fd) {
    bool keep = fd == report_fd;
    for (const auto& m : mappings) keep = keep || fd == m.theirs;
    if (!keep) fcntl(fd, F_SETFD, FD_CLOEXEC);
  }
}

[[noreturn]] void run_child(Launch& launch) {
  if (launch.plan.own_group) setpgid(0, 0);
  if (launch.plan.die_with_parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != launch.parent) _exit(kCannotExec);  // it ended in between
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int number : {SIGINT, SIGTERM, SIGPIPE}) signal(number, SIG_DFL);
  const bool ready = map_descriptors(launch.plan.descriptors) &&
                     (launch.plan.folder.empty() || chdir(launch.plan.folder.c_str()) == 0);
  if (ready) {
    close_others(launch.plan.descriptors, launch.report_fd);
    environ = launch.envp.data();
    execvp(launch.argv[0], launch.argv.data());
  }
  const int reason = errno;
  static_cast<void>(!::write(launch.report_fd, &reason, sizeof reason));
  _exit(kCannotExec);
}

ExitStatus decode_status(int status) {
  if (WIFSIGNALED(status)) return {.code = 0, .signal = WTERMSIG(status)};
  return {.code = WEXITSTATUS(status), .signal = 0};
}

}  // namespace

Result<Process, Problem> Process::spawn(const ProcessPlan& plan) {
  CHECK(!plan.argv.empty());
  const std::string& program = plan.argv[0];
  std::array<int, 2> report{};
  const auto piped = posix_call([&] { return pipe2(report.data(), O_CLOEXEC); });
  if (!piped.ok()) return Unexpected{Problem{program, piped.reason()}};
  const FileDescriptor read_end(report[0]);
  FileDescriptor write_end(posix_call([&] {  // out of the way of every mapped descriptor
    return fcntl(report[1], F_DUPFD_CLOEXEC, 512);
  }));
  ::close(report[1]);
  if (!write_end.valid()) return Unexpected{Problem{program, "no file descriptor is left"}};

  std::vector<std::string> argv = plan.argv;
  Launch launch{
      merged_environment(plan.environment), pointers(argv), {}, plan, write_end.get(), getpid()};
  launch.envp = pointers(launch.environment);
  const auto forked = posix_call([] { return fork(); });
  if (!forked.ok()) return Unexpected{Problem{program, forked.reason()}};
  if (forked.value == 0) run_child(launch);
  write_end.reset();

  const auto pid = static_cast<pid_t>(forked.value);
  int reason = 0;
  const auto reported = posix_call([&] { return ::read(read_end.get(), &reason, sizeof reason); });
  if (reported.ok() && reported.value == sizeof reason) {
    int status = 0;
    static_cast<void>(posix_call([&] { return waitpid(pid, &status, 0); }));
    return Unexpected{Problem{program, PosixOutcome{.value = -1, .error = reason}.reason()}};
  }
  FileDescriptor pidfd(posix_call([&] { return syscall(SYS_pidfd_open, pid, 0); }));
  return Process(pid, std::move(pidfd), plan.own_group);
}

Process::Process(Process&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      pidfd_(std::move(other.pidfd_)),
      own_group_(other.own_group_),
      status_(other.status_) {}

Process& Process::operator=(Process&& other) noexcept {
  if (this == &other) return *this;
  end();
  pid_ = std::exchange(other.pid_, -1);
  pidfd_ = std::move(other.pidfd_);
  own_group_ = other.own_group_;
  status_ = other.status_;
  return *this;
}

Process::~Process() { end(); }

void Process::end() {
  if (pid_ < 0 || status_) return;
  kill(SIGKILL);
  static_cast<void>(wait());
}

// First looks without reaping: as long as the child is not reaped, its number cannot belong to
// somebody else, so what is left of its group can be ended safely.
std::optional<ExitStatus> Process::reap(int options) {
  if (status_) return status_;
  siginfo_t ended{};
  const auto looked = posix_call(
      [&] { return waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOWAIT | options); });
  if (looked.ok() && ended.si_pid != pid_) return std::nullopt;
  if (own_group_ && looked.ok())
    static_cast<void>(posix_call([&] { return killpg(pid_, SIGKILL); }));
  int status = 0;
  const auto waited = posix_call([&] { return waitpid(pid_, &status, 0); });
  status_ = waited.ok() ? decode_status(status) : ExitStatus{.code = kCannotExec, .signal = 0};
  return status_;
}

std::optional<ExitStatus> Process::poll() { return reap(WNOHANG); }

ExitStatus Process::wait() { return *reap(0); }

std::optional<ExitStatus> Process::wait_until(Instant deadline) {
  constexpr Duration kPollPeriod =
      milliseconds(5);  // only where the kernel has no pidfd (before 5.3)
  while (true) {
    if (const auto status = poll()) return status;
    const Instant now = monotonic_now();
    if (now >= deadline) return std::nullopt;
    const int watched[] = {pidfd_.get()};
    wait_readable(watched, pidfd_.valid() ? deadline : std::min(deadline, now + kPollPeriod));
  }
}

void Process::kill(int signal) {
  if (pid_ < 0 || status_) return;
  if (own_group_) static_cast<void>(posix_call([&] { return killpg(pid_, signal); }));
  static_cast<void>(posix_call([&] { return ::kill(pid_, signal); }));
}

Result<StopSignal, Problem> StopSignal::install() {
  sigset_t stops;
  sigemptyset(&stops);
  sigaddset(&stops, SIGINT);
  sigaddset(&stops, SIGTERM);
  const auto blocked = posix_call([&] { return pthread_sigmask(SIG_BLOCK, &stops, nullptr); },
                                  Success::kZeroElseNumber);
  if (!blocked.ok()) return Unexpected{Problem{"SIGINT, SIGTERM", blocked.reason()}};
  const auto made = posix_call([&] { return signalfd(-1, &stops, SFD_CLOEXEC | SFD_NONBLOCK); });
  if (!made.ok()) return Unexpected{Problem{"signalfd", made.reason()}};
  return StopSignal(FileDescriptor(made));
}

bool StopSignal::raised() {
  signalfd_siginfo info{};
  while (posix_call([&] { return ::read(fd_.get(), &info, sizeof info); }).ok()) raised_ = true;
  return raised_;
}

}  // namespace pitwall::transport
