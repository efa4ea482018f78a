// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/include_rules.hpp"

#include <algorithm>
#include <regex>
#include <set>
#include <string_view>

namespace pitwall::tidy {
namespace {

using Names = std::vector<std::string_view>;

// Headers outside the tree, by what they bring in. "std" is every other header without '/' or '.'.
struct Library {
  std::string_view name;
  Names headers;  // a header's full name, or the beginning of it when it ends with '/' or '_'
};

const std::vector<Library> kLibraries{
    {"threads",
     {"thread", "mutex", "condition_variable", "future", "shared_mutex", "stop_token", "semaphore",
      "latch", "barrier", "pthread.h"}},
    {"clocks", {"chrono", "ctime", "time.h", "sys/time.h", "sys/timerfd.h"}},
    {"files", {"fstream", "filesystem"}},
    {"console", {"iostream"}},
    {"random", {"random"}},
    {"assert", {"cassert", "assert.h"}},
    {"system", {"unistd.h",  "fcntl.h",  "poll.h",   "sched.h",  "signal.h", "csignal",
                "termios.h", "spawn.h",  "malloc.h", "dirent.h", "netdb.h",  "errno.h",
                "pty.h",     "sys/",     "net/",     "netinet/", "arpa/",    "linux/",
                "ifaddrs.h", "syslog.h", "dlfcn.h",  "grp.h",    "pwd.h"}},
    {"eigen", {"Eigen/"}},
    {"yaml", {"yaml-cpp/"}},
    {"cli", {"CLI/"}},
    {"lapack", {"lapacke.h"}},
    {"geographic", {"GeographicLib/"}},
    {"pcl", {"pcl/"}},
    {"opencv", {"opencv2/"}},
    {"turbojpeg", {"turbojpeg.h"}},
    {"sodium", {"sodium.h"}},
    {"lcm", {"lcm/"}},
    {"dds", {"fastdds/", "fastrtps/", "fastcdr/"}},
    {"boost", {"boost/"}},
    {"openssl", {"openssl/"}},
    {"zlib", {"zlib.h"}},
    {"bags", {"sqlite3.h", "lz4frame.h", "zstd.h"}},
    {"embree", {"embree3/", "embree4/"}},
    {"spiro", {"spiroentrypoints.h", "bezctx.h"}},
    {"test", {"gtest/", "gmock/", "benchmark/"}},
};

struct Part {
  std::string_view path;  // a folder or a file; the longest that fits decides
  Names may_include;      // besides its own folder
  Names libraries;        // besides std
};

const Names kRim{"threads", "clocks", "files", "console", "system"};

Names rim_and(Names more) {
  more.insert(more.end(), kRim.begin(), kRim.end());
  return more;
}

const Names kShared{"protocol/vocabulary", "protocol/bits"};
const Names kAutonomy{"vehicle/world", "vehicle/steering", "protocol/vocabulary"};
const Names kBench{"hil",
                   "vehicle/pipeline",
                   "vehicle/world",
                   "vehicle/receivers",
                   "vehicle/parameters",
                   "protocol",
                   "basestation/link",
                   "basestation/inputs",
                   "basestation/command",
                   "basestation/alarms",
                   "basestation/state",
                   "basestation/service"};

// What a publisher reads, and where it submits: it owns nothing that judges.
const Names kSnapshots{"basestation/service", "basestation/command", "basestation/alarms",
                       "basestation/state", "protocol"};

Names bench_and(Names more) {
  more.insert(more.end(), kBench.begin(), kBench.end());
  return more;
}

Names publisher_and(Names more) {
  more.insert(more.end(), kSnapshots.begin(), kSnapshots.end());
  return more;
}

const std::vector<Part> kParts{
    {"protocol/vocabulary", {}, {}},
    {"protocol/vocabulary/check.hpp", {}, {}},
    {"protocol/bits", {"protocol/vocabulary"}, {"sodium"}},
    {"protocol/yaml", {"protocol/vocabulary"}, {"yaml", "files"}},
    {"protocol/json", {"protocol/vocabulary"}, {}},
    {"protocol/can", {"protocol/vocabulary", "protocol/bits", "protocol/yaml"}, {"yaml", "files"}},
    {"protocol/telemetry", kShared, {}},
    {"protocol/telemetry/session",
     {"protocol/telemetry", "protocol/vocabulary", "protocol/bits"},
     {"sodium"}},
    {"protocol/recording", kShared, {}},
    {"protocol/recorder", {"protocol"}, rim_and({})},
    {"protocol/ros", kShared, {}},
    {"protocol/dds", {"protocol/vocabulary"}, rim_and({"dds"})},
    {"protocol/gnss", kShared, {}},
    {"protocol/rules", {"protocol/vocabulary"}, {}},
    {"protocol/transport", {"protocol/vocabulary", "protocol/can/frame.hpp"}, rim_and({})},
    {"protocol/transport/stream",
     {"protocol/transport", "protocol/vocabulary", "protocol/bits"},
     rim_and({})},
    {"vehicle/world", {"protocol/vocabulary"}, {}},
    {"vehicle/steering", {"vehicle/world", "protocol/vocabulary"}, {}},
    {"vehicle/envelope", {"vehicle/steering", "vehicle/world", "protocol/vocabulary"}, {}},
    {"vehicle/gateway", {"vehicle/world", "protocol/can", "protocol/vocabulary"}, {}},
    {"vehicle/autonomy", kAutonomy, {"eigen"}},
    {"vehicle/autonomy/perception", kAutonomy, {"eigen", "pcl", "opencv"}},
    {"vehicle/autonomy/localization", kAutonomy, {"eigen", "geographic"}},
    {"vehicle/autonomy/tracking", kAutonomy, {"eigen"}},
    {"vehicle/autonomy/planning",
     {"vehicle/envelope", "vehicle/world", "vehicle/steering", "protocol/rules",
      "protocol/vocabulary"},
     {"eigen"}},
    {"vehicle/autonomy/control",
     {"vehicle/envelope", "vehicle/world", "vehicle/steering", "protocol/vocabulary"},
     {"eigen", "lapack"}},
    {"vehicle/receivers", {"vehicle/world", "protocol/gnss", "protocol/vocabulary"}, {}},
    {"vehicle/safety",
     {"vehicle/steering", "vehicle/world", "protocol/can", "protocol/vocabulary"},
     {}},
    {"vehicle/guardian",
     {"vehicle/safety", "vehicle/steering", "vehicle/world", "protocol/can", "protocol/vocabulary"},
     {}},
    {"vehicle/pipeline",
     {"vehicle/world", "vehicle/steering", "vehicle/gateway", "vehicle/autonomy", "vehicle/safety",
      "vehicle/guardian", "protocol/telemetry", "protocol/rules", "protocol/can",
      "protocol/vocabulary"},
     {"eigen"}},
    {"vehicle/parameters",
     {"vehicle/envelope", "vehicle/world", "vehicle/pipeline", "vehicle/raceline",
      "protocol/vocabulary", "protocol/yaml"},
     {"yaml", "files"}},  // names of files beside one: the reader is given
    {"vehicle/raceline",
     {"vehicle/envelope", "vehicle/world", "protocol/bits", "protocol/json", "protocol/yaml",
      "protocol/vocabulary"},
     {}},
    {"vehicle/io", {"vehicle", "protocol"}, rim_and({"cli"})},
    {"vehicle/io/perception", {"vehicle", "protocol"}, rim_and({"turbojpeg"})},
    {"basestation/link", {"protocol"}, rim_and({})},
    {"basestation/inputs", {"basestation/command", "basestation/alarms", "protocol"}, rim_and({})},
    {"basestation/state", {"protocol/telemetry", "protocol/rules", "protocol/vocabulary"}, {}},
    {"basestation/alarms",
     {"basestation/state", "protocol/telemetry", "protocol/rules", "protocol/vocabulary"},
     {}},
    {"basestation/command",
     {"basestation/state", "basestation/alarms", "protocol/telemetry", "protocol/vocabulary"},
     {}},
    {"basestation/service",
     {"basestation/link", "basestation/inputs", "basestation/state", "basestation/alarms",
      "basestation/command", "basestation/settings", "basestation/replay", "protocol"},
     rim_and({})},
    {"basestation/publishers/bench", kSnapshots, rim_and({})},
    {"basestation/publishers/console",
     publisher_and(
         {"basestation/publishers/bench", "basestation/publishers/web", "basestation/replay"}),
     rim_and({})},
    {"basestation/publishers/dds",
     publisher_and({"basestation/publishers/feed", "basestation/publishers/ros_view"}),
     rim_and({})},
    {"basestation/publishers/feed", publisher_and({"basestation/publishers/ros_view"}),
     rim_and({})},
    {"basestation/publishers/foxglove",
     publisher_and({"basestation/publishers/feed", "basestation/publishers/ros_view",
                    "basestation/publishers/web", "basestation/replay"}),
     rim_and({})},
    {"basestation/publishers/lcm", publisher_and({"basestation/publishers/feed"}),
     rim_and({"lcm"})},
    {"basestation/publishers/metrics", publisher_and({"basestation/publishers/web"}), rim_and({})},
    {"basestation/publishers/recorder", kSnapshots, rim_and({})},
    {"basestation/publishers/ros_view", kSnapshots, {"files"}},
    {"basestation/publishers/text", kSnapshots, rim_and({})},
    {"basestation/publishers/web", kSnapshots, rim_and({"boost", "openssl", "sodium", "zlib"})},
    {"basestation/settings",
     {"basestation/state", "basestation/alarms", "protocol/telemetry", "protocol/rules",
      "protocol/json", "protocol/yaml", "protocol/vocabulary"},
     {"files", "cli"}},
    {"basestation/replay", {"protocol"}, {}},
    {"basestation/session", {"basestation", "protocol"}, {}},
    {"hil", kBench, {"eigen"}},
    {"hil/scenario", kBench, {"yaml"}},
    {"hil/replay", kBench, {"zlib"}},
    {"hil/replay/recordings", kBench, {"bags"}},
    {"hil/sensors", kBench, {"eigen", "embree", "geographic"}},
    // Its lens is the one that the car's calibration files describe.
    {"hil/sensors/camera", bench_and({"vehicle/autonomy/perception/camera"}), {"eigen"}},
    {"hil/bench", kBench, rim_and({"eigen"})},
    // It publishes detections as the car's own rim reads them.
    {"hil/bench/live", bench_and({"vehicle/io/ingress", "vehicle/io/perception"}),
     rim_and({"eigen"})},
    // Ray by ray, it needs the car's detector behind the LiDARs.
    {"hil/bench/lockstep", bench_and({"vehicle/autonomy/perception"}), rim_and({"eigen"})},
    // A run is driven again by what the car's own rim kept of it.
    {"hil/bench/recorded", bench_and({"vehicle/io"}), rim_and({})},
    {"hil/can_bus", kBench, rim_and({})},
    {"hil/cli", kBench, rim_and({"cli"})},
    // Scenes as the car's network sees them.
    {"hil/scenes", bench_and({"vehicle/autonomy/perception"}), {"files"}},
    // One module of the car by itself, on a public benchmark.
    {"hil/cli/kitti", bench_and({"vehicle/autonomy/tracking"}), {}},
    // Its results are a file for SQL.
    {"hil/sweep", kBench, rim_and({"bags"})},
    {"tests", {"protocol", "vehicle", "basestation", "hil"}, {"*"}},
};

// Who includes such a header pays for it with seconds, and a header makes all its readers pay.
struct HeavyLibrary {
  std::string_view name;
  Names headers;  // of the product that may include it: read by files that need it anyway
};

const std::vector<HeavyLibrary> kHeavyLibraries{
    {"eigen",
     {"vehicle/autonomy/control/bicycle_model.hpp", "vehicle/autonomy/control/riccati.hpp",
      "vehicle/autonomy/localization/filter/ekf_model.hpp",
      "vehicle/autonomy/localization/filter/ekf_3d_errors.hpp",
      "vehicle/autonomy/localization/filter/ekf_3d_model.hpp",
      "vehicle/autonomy/localization/filter/rotation.hpp"}},
    {"boost",
     {"basestation/publishers/web/http_session.hpp", "basestation/publishers/web/web_engine.hpp",
      "basestation/publishers/web/wire.hpp"}},
    {"cli", {}},
    {"dds", {}},
    {"yaml", {}},
    {"pcl", {}},
    {"opencv", {}},
};

// A main.cpp wires: its whole top-level folder and the protocol, and the system.
Part part_of_main(const std::string& path) {
  const std::string_view top = std::string_view{path}.substr(0, path.find('/'));
  Names may{"protocol", top};
  if (top == "hil") may.insert(may.end(), {"vehicle", "basestation"});
  return {path, may, rim_and({"cli", "yaml"})};
}

Part part_of(const std::string& path) {
  if (!lies_in(path, "tests") && path.ends_with("/main.cpp")) return part_of_main(path);
  const Part* best = nullptr;
  for (const Part& part : kParts) {
    if (lies_in(path, part.path) && (!best || part.path.size() > best->path.size())) best = &part;
  }
  return best ? *best : Part{"", {}, {}};
}

bool is_header_of(std::string_view target, std::string_view header) {
  return header.ends_with('/') ? target.starts_with(header) : target == header;
}

std::string_view library_of(std::string_view target) {
  for (const Library& library : kLibraries) {
    for (const std::string_view header : library.headers) {
      if (is_header_of(target, header)) return library.name;
    }
  }
  return target.find_first_of("./") == std::string_view::npos ? "std" : "unknown";
}

bool may_include(const Part& part, const std::string& folder, const std::string& target) {
  if (folder_of(target) == folder || lies_in(folder, "tests")) return true;
  // The folder of a part is one with its subfolders.
  if (!part.path.ends_with(".cpp") && lies_in(target, part.path) && part.path != "hil" &&
      part.path != "vehicle/autonomy") {
    return true;
  }
  // The parameter file is read into the parameter structs of every module.
  if (part.path == "vehicle/parameters" && lies_in(target, "vehicle") &&
      target.find("param") != std::string::npos) {
    return true;
  }
  return std::ranges::any_of(part.may_include, [&](auto may) { return lies_in(target, may); });
}

bool may_use(const Part& part, std::string_view library) {
  return library == "std" || std::ranges::find(part.libraries, "*") != part.libraries.end() ||
         std::ranges::find(part.libraries, library) != part.libraries.end();
}

// What makes an include heavy: its library, or the table's header that brings a library in.
const HeavyLibrary* heavy_library_of(std::string_view target) {
  const std::string_view name = library_of(target);
  const auto found = std::ranges::find_if(kHeavyLibraries, [&](const HeavyLibrary& library) {
    return library.name == name ||
           std::ranges::find(library.headers, target) != library.headers.end();
  });
  return found == kHeavyLibraries.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Include> includes_of(const SourceFile& file) {
  static const std::regex kInclude{R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])"};
  static const std::regex kDirective{R"(^\s*#\s*include\b)"};
  const std::vector<std::string> lines = split_lines(file.text);
  const std::vector<std::string> code = split_lines(file.code);
  std::vector<Include> includes;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_search(code[i], kDirective)) continue;  // in a comment
    if (!std::regex_search(lines[i], match, kInclude)) continue;
    includes.push_back({match[2], match[1] == "\"", i + 1});
  }
  return includes;
}

std::vector<Finding> check_include_table(const SourceFile& file) {
  std::vector<Finding> findings;
  if (!is_cpp(file)) return findings;
  const Part part = part_of(file.path);
  const std::string folder = folder_of(file.path);
  static const std::set<std::string, std::less<>> kTops{"protocol", "vehicle", "basestation", "hil",
                                                        "tests"};
  for (const Include& include : includes_of(file)) {
    const std::string target = include.target;
    const bool ours = kTops.contains(target.substr(0, target.find('/')));
    if (ours && !include.quoted) {
      findings.push_back({file.path, include.line, "write \"" + target + "\" with quotes"});
    } else if (include.quoted && !ours) {
      findings.push_back({file.path, include.line, target + " is no full path from the root"});
    } else if (ours && !may_include(part, folder, target)) {
      findings.push_back({file.path, include.line, folder + " may not include " + target});
    } else if (!ours && !may_use(part, library_of(target))) {
      findings.push_back(
          {file.path, include.line,
           folder + " may not use <" + target + "> (" + std::string{library_of(target)} + ")"});
    }
  }
  if (part.path.empty()) findings.push_back({file.path, 0, "the include table has no such part"});
  return findings;
}

std::vector<Finding> check_heavy_headers(const SourceFile& file) {
  std::vector<Finding> findings;
  if (!is_header(file) || is_test(file)) return findings;
  for (const Include& include : includes_of(file)) {
    const HeavyLibrary* const library = heavy_library_of(include.target);
    if (library == nullptr) continue;
    if (std::ranges::find(library->headers, file.path) != library->headers.end()) continue;
    findings.push_back({file.path, include.line,
                        include.target + " takes seconds to compile (" +
                            std::string{library->name} + "): include it in a .cpp"});
  }
  return findings;
}

std::vector<Finding> check_own_header_first(const SourceFile& file, bool has_header) {
  if (!file.path.ends_with(".cpp") || !has_header) return {};
  const std::string own = folder_of(file.path) + "/" + stem_of(file.path) + ".hpp";
  const std::vector<Include> includes = includes_of(file);
  if (!includes.empty() && includes.front().target == own) return {};
  return {{file.path, includes.empty() ? 0 : includes.front().line, "include " + own + " first"}};
}

}  // namespace pitwall::tidy
