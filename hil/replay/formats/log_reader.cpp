// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/log_reader.hpp"

#include <string>

#include "hil/replay/formats/asc.hpp"
#include "hil/replay/formats/blf.hpp"
#include "hil/replay/formats/candump.hpp"
#include "hil/replay/formats/gzip.hpp"
#include "hil/replay/formats/pcap.hpp"
#include "hil/replay/formats/pcapng.hpp"
#include "hil/replay/formats/recognise.hpp"
#include "hil/replay/formats/trc.hpp"

namespace pitwall::replay {
namespace {

Unexpected<Problem> unreadable(FileFormat format, std::string_view file_name) {
  std::string what = "looks like " + std::string(name_of(format));
  if (const auto advice = advice_on(format); !advice.empty()) what += "; " + std::string(advice);
  return refuse(file_name, what + ". These are read: " + std::string(formats_that_are_read()));
}

Result<CanLog, Problem> read_as(FileFormat format, std::string_view bytes,
                                std::string_view file_name, const LogWatch& watch) {
  switch (format) {
    case FileFormat::kCandump:
      return read_candump(bytes, file_name, watch);
    case FileFormat::kAsc:
      return read_asc(bytes, file_name, watch);
    case FileFormat::kBlf:
      return read_blf(bytes, file_name, watch);
    case FileFormat::kTrc:
      return read_trc(bytes, file_name, watch);
    case FileFormat::kPcap:
      return read_pcap(bytes, file_name, watch);
    case FileFormat::kPcapng:
      return read_pcapng(bytes, file_name, watch);
    default:
      return unreadable(format, file_name);
  }
}

Result<CanLog, Problem> read_packed(std::string_view bytes, std::string_view file_name,
                                    const LogWatch& watch) {
  const Unpacked unpacked = unpack_gzip(bytes);
  const std::string at = std::string(file_name) + ": byte " + std::to_string(unpacked.at);
  if (unpacked.bytes.empty() && !unpacked.problem.empty())
    return refuse(at, "looks like a gzip file, but " + unpacked.problem);
  auto log = read_as(recognise(unpacked.bytes), unpacked.bytes, file_name, watch);
  if (!log) return log;
  log->format += " (gzip)";
  if (unpacked.problem.empty()) return log;
  ++(unpacked.is_cut ? log->counters.cut_tails : log->counters.bad_records);
  log->remarks.push_back({at, "what follows: " + unpacked.problem});
  return log;
}

}  // namespace

Result<CanLog, Problem> read_can_log(std::string_view bytes, std::string_view file_name,
                                     const LogWatch& watch) {
  const FileFormat format = recognise(bytes);
  return format == FileFormat::kGzip ? read_packed(bytes, file_name, watch)
                                     : read_as(format, bytes, file_name, watch);
}

}  // namespace pitwall::replay
