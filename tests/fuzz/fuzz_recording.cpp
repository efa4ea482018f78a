// SPDX-License-Identifier: Apache-2.0
// Any bytes are a recording in total order, every record of which can be read, or an error with
// words; merged with itself it has every record twice. The first byte chooses a magic number to put
// in front, so that every reader is reached.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hil/replay/recordings/merge.hpp"
#include "hil/replay/recordings/recording_reader.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::traffic;

std::string file_of(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::size_t kChoices = 5;
  constexpr std::string_view kMcap{"\x89MCAP0\r\n", 8}, kSqlite{"SQLite format 3\0", 16};
  constexpr std::string_view kLcm{"\xED\xA1\xDA\x01", 4}, kZstd{"\x28\xB5\x2F\xFD", 4};
  if (size == 0) return {};
  const std::string rest{reinterpret_cast<const char*>(bytes) + 1, size - 1};
  switch (bytes[0] % kChoices) {
    case 0:
      return std::string{kMcap} + rest;
    case 1:
      return std::string{kSqlite} + rest;
    case 2:
      return std::string{kLcm} + rest;
    case 3:
      return std::string{kZstd} + rest;
    default:
      return rest;
  }
}

std::uint64_t check(const Recording& recording) {
  CHECK(std::ranges::is_sorted(recording.records, precedes));
  std::uint64_t records = 0, sum = 0;
  for (const Source& source : recording.sources) records += source.records;
  CHECK(records == recording.records.size());
  for (const Record& record : recording.records) {
    CHECK(record.source < recording.sources.size());
    CHECK(record.sequence < recording.sources[record.source].records);
    for (const std::uint8_t byte : record.bytes()) sum += byte;
  }
  for (const Remark& remark : recording.remarks) CHECK(!remark.what.empty() && remark.times > 0);
  return sum;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string file = file_of(bytes, size);
  auto once = read_recording(file, "f");
  auto again = read_recording(file, "f");
  CHECK(once.has_value() == again.has_value());
  if (!once) {
    CHECK(!once.error().what.empty());
    return 0;
  }
  const std::uint64_t sum = check(*once);
  const std::size_t records = once->records.size();
  std::vector<MergeInput> inputs;
  inputs.push_back({*std::move(once), "a", seconds(1)});
  inputs.push_back({*std::move(again), "b", {}});
  const auto merged = merge(std::move(inputs));
  CHECK(merged.has_value() && merged->records.size() == 2 * records && check(*merged) == 2 * sum);
  return 0;
}
