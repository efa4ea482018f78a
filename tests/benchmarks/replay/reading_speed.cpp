// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/reading_speed.hpp"

#include <algorithm>
#include <charconv>

#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/writers/log_writer.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr const char* kReader =
    "import can, sys, time\n"
    "best = 1e9\n"
    "for _ in range(int(sys.argv[4])):\n"
    "  start = time.thread_time()\n"
    "  count = sum(1 for _ in getattr(can, sys.argv[1])(sys.argv[2]))\n"
    "  best = min(best, time.thread_time() - start)\n"
    "open(sys.argv[3], 'w').write('%d %.9f' % (count, best))\n";

Result<double, Problem> seconds_of_python(const std::string& reader, const std::string& file,
                                          std::size_t frames) {
  const std::string out = file + ".python";
  auto python = transport::Process::spawn(
      {.argv = {"/usr/bin/python3", "-c", kReader, reader, file, out, std::to_string(kReadings)}});
  if (!python || !python->wait().success())
    return refuse("python-can", "does not read the log (python3-can installed?)");
  const std::string text = transport::read_file(out).value_or("");
  std::size_t count = 0;
  double best_s = 0.0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, count);
  if (first.ptr == end || std::from_chars(first.ptr + 1, end, best_s).ec != std::errc{} ||
      count != frames)
    return refuse("python-can", "reads " + text + ", expected " + std::to_string(frames));
  return best_s;
}

Result<double, Problem> seconds_of_ours(const std::string& file, std::size_t frames) {
  Duration best{INT64_MAX};
  for (int i = 0; i < kReadings; ++i) {
    const Duration start = transport::thread_time();
    const auto bytes = transport::read_file(file);
    if (!bytes) return Unexpected{bytes.error()};
    const auto log = replay::read_can_log(*bytes, file);
    best = std::min(best, transport::thread_time() - start);
    if (!log) return Unexpected{log.error()};
    if (log->frames.size() != frames) return refuse(file, "is not read whole");
  }
  return best.seconds();
}

}  // namespace

Result<ReadingSpeeds, Problem> measure_reading(const replay::CanLog& log,
                                               const std::string& folder) {
  ReadingSpeeds out{ReadingSpeed{.format = "candump"}, ReadingSpeed{.format = "ASC"}};
  const std::array<std::pair<const char*, const char*>, 2> kFiles{
      {{"/reading.log", "CanutilsLogReader"}, {"/reading.asc", "ASCReader"}}};
  const auto frames = static_cast<double>(log.frames.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::string file = folder + kFiles[i].first;
    const auto written = replay::write_can_log(log, file);
    if (!written) return Unexpected{written.error()};
    if (const auto done = transport::write_file(file, written->bytes); !done)
      return Unexpected{done.error()};
    const auto ours_s = seconds_of_ours(file, log.frames.size());
    if (!ours_s) return Unexpected{ours_s.error()};
    const auto python_s = seconds_of_python(kFiles[i].second, file, log.frames.size());
    if (!python_s) return Unexpected{python_s.error()};
    out[i].ours_per_s = frames / *ours_s;
    out[i].python_per_s = frames / *python_s;
  }
  return out;
}

}  // namespace pitwall::benchmarks
