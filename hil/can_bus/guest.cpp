// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/guest.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "hil/can_bus/register_state/ptrace_library.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"

extern char** environ;

namespace pitwall::can_bus {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "linux.uml";
constexpr const char* kModules = "/usr/lib/uml/modules";
constexpr const char* kMemoryFolder = "/dev/shm";  // where the guest's memory lives, as a file
constexpr std::size_t kForwardBytes = 16 * 1024;

bool is_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string rest = path == nullptr ? "/usr/bin" : path;
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    std::error_code ignored;
    if (fs::exists(fs::path(rest.substr(0, colon)) / program, ignored)) return true;
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return false;
}

// Less than asked where the host's memory file system is small (containers have 64 MiB of it): a
// guest that runs out of it is killed without a word.
int affordable_memory_mib(int wanted_mib) {
  std::error_code error;
  const auto space = fs::space(kMemoryFolder, error);
  if (error) return wanted_mib;
  const auto free_mib = static_cast<int>(std::min<std::uintmax_t>(space.available >> 20, 1 << 20));
  return std::min(wanted_mib, free_mib * 9 / 10);
}

std::vector<std::string> guest_environment(const std::vector<std::string>& additions) {
  std::vector<std::string> out;
  for (char** entry = environ; *entry != nullptr; ++entry) out.emplace_back(*entry);
  out.insert(out.end(), additions.begin(), additions.end());
  return out;
}

bool forward(transport::FileDescriptor& from, std::FILE* to) {
  std::array<std::uint8_t, kForwardBytes> bytes;
  bool any = false;
  while (from.valid()) {
    const auto got = transport::read_available(from.get(), bytes);
    if (got.ended) from.reset();
    if (got.bytes == 0) break;
    std::fwrite(bytes.data(), 1, got.bytes, to);
    any = true;
  }
  if (any) std::fflush(to);
  return any;
}

std::string last_lines(const std::string& text) {
  constexpr std::size_t kShown = 2'000;
  return text.size() <= kShown ? text : text.substr(text.size() - kShown);
}

}  // namespace

std::optional<Problem> guest_obstacle() {
  std::error_code ignored;
  if (!is_in_path(kProgram))
    return Problem{kProgram, "not installed (Debian package user-mode-linux)"};
  if (!fs::is_directory(kModules, ignored)) return Problem{kModules, "no such folder"};
  for (const char* tool : {"ip", "stty", "mount"})
    if (!is_in_path(tool) && !fs::exists(fs::path("/usr/sbin") / tool, ignored))
      return Problem{tool, "not installed; a guest needs it"};
  if (const int memory_mib = affordable_memory_mib(kLeastMemory_mib); memory_mib < kLeastMemory_mib)
    return Problem{kMemoryFolder, "a guest needs " + std::to_string(kLeastMemory_mib) +
                                      " MiB there, " + std::to_string(memory_mib) + " are free"};
  return std::nullopt;
}

Result<Guest, Problem> Guest::boot(const GuestPlan& plan) {
  if (plan.command.empty()) return Unexpected{Problem{"guest", "no command to run"}};
  if (auto obstacle = guest_obstacle()) return Unexpected{*std::move(obstacle)};
  auto folder = transport::TemporaryFolder::create("pitwall-guest-");
  if (!folder) return Unexpected{folder.error()};
  auto ends = transport::stream_pair();
  if (!ends) return Unexpected{ends.error()};
  auto clock_ends = transport::stream_pair();
  if (!clock_ends) return Unexpected{clock_ends.error()};
  auto line = transport::SerialLine::adopt(std::move(ends->first));
  if (!line) return Unexpected{line.error()};
  auto clock = transport::SerialLine::adopt(std::move(clock_ends->first));
  if (!clock) return Unexpected{clock.error()};
  Guest guest(*std::move(folder), *std::move(line), *std::move(clock));
  const auto started = guest.start(plan, ends->second.get(), clock_ends->second.get());
  if (!started) return Unexpected{started.error()};
  return guest;
}

Result<bool, Problem> Guest::start(const GuestPlan& plan, int line_end, int clock_end) {
  const std::string& folder = folder_.path();
  std::error_code error;
  const std::string working = fs::current_path(error).string();
  const auto environment = guest_environment(plan.environment);
  const std::string init = folder + "/init";
  const auto written =
      transport::write_file(init, init_script(plan, folder, working, environment), 0700);
  if (!written) return written;
  const auto preloaded = preloaded_ptrace(folder);
  if (!preloaded) return Unexpected{preloaded.error()};
  auto console = transport::AppendWriter::open(folder + "/console");
  auto null = transport::AppendWriter::open("/dev/null");
  auto output = transport::stream_pair();
  auto errors = transport::stream_pair();
  auto life = transport::stream_pair();
  if (!console) return Unexpected{console.error()};
  if (!null) return Unexpected{null.error()};
  if (!output) return Unexpected{output.error()};
  if (!errors) return Unexpected{errors.error()};
  if (!life) return Unexpected{life.error()};

  constexpr int kLine = 3, kOutput = 4, kErrors = 5, kClock = 6;
  const auto fd = [](int n) { return "fd:" + std::to_string(n); };
  const std::string memory = std::to_string(affordable_memory_mib(plan.memory_mib));
  // User-mode Linux changes between its kernel and its processes at every system call. Where the
  // host spreads these over processors, waking the other one each time makes a call four times as
  // slow (measured: 75 us, and 17 us on one), so the guest stays on the last.
  std::optional<transport::OnOneProcessor> pinned{-1};
  auto machine = transport::Process::spawn(
      {.argv = {kProgram, "mem=" + memory + "M", "rootfstype=hostfs", "hostfs=/", "rw",
                "init=" + init, "uml_dir=" + folder + "/uml", "con=null", "con0=null,fd:1",
                "ssl=null", "ssl0=" + fd(kLine), "ssl1=null," + fd(kOutput),
                "ssl2=null," + fd(kErrors), "ssl3=" + fd(kClock), "quiet"},
       .descriptors = {{null->fd(), 0},
                       {console->fd(), 1},
                       {console->fd(), 2},
                       {line_end, kLine},
                       {output->second.get(), kOutput},
                       {errors->second.get(), kErrors},
                       {clock_end, kClock}},
       .environment = {*preloaded},
       .own_group = true});
  pinned.reset();
  if (!machine) return Unexpected{machine.error()};
  transport::raise_priority(
      machine->pid());  // where it may not, the bench tells what it waited for
  machine_.process = *std::move(machine);
  output_ = std::move(output->first);
  errors_ = std::move(errors->first);
  lifeline_ = std::move(life->first);
  // User-mode Linux is a handful of processes; a death signal to the first leaves the others. The
  // cleanup reads until our end of its pipe is gone, however we end, then kills the group and
  // removes the folder that we left.
  auto cleanup = transport::Process::spawn(
      {.argv = {"/bin/sh", "-c", "trap '' INT TERM HUP; read _; kill -KILL -$0; rm -rf \"$1\"",
                std::to_string(machine_.process->pid()), folder},
       .descriptors = {{life->second.get(), 0}, {null->fd(), 1}, {null->fd(), 2}},
       .die_with_parent = false,
       .own_group = true});
  if (!cleanup) return Unexpected{cleanup.error()};
  cleanup_process_ = *std::move(cleanup);
  return true;
}

std::optional<Result<int, Problem>> Guest::serve() {
  const bool off = machine_.process->poll().has_value();  // asked first: what follows is the rest
  forward(output_, stdout);
  forward(errors_, stderr);
  if (!off) return std::nullopt;
  cleanup_process_.reset();
  return outcome();
}

Result<int, Problem> Guest::outcome() const {
  const auto text = transport::read_file(folder_.path() + "/" + std::string(kExitCodeFile));
  int code = 0;
  if (text) {
    const auto parsed = std::from_chars(text->data(), text->data() + text->size(), code);
    if (parsed.ec == std::errc{}) return code;
  }
  const auto problem = transport::read_file(folder_.path() + "/" + std::string(kProblemFile));
  const auto console = transport::read_file(folder_.path() + "/console");
  std::string what = "went down before the command ended";
  if (problem) what += ": " + *problem;
  if (console) what += "\n" + last_lines(*console);
  return Unexpected{Problem{"guest", what}};
}

}  // namespace pitwall::can_bus
