// SPDX-License-Identifier: Apache-2.0
// Any bytes are a recording in total order, every record of which can be read, or an error with
// words; merged with itself it has every record twice. One program for each reader, by
// PITWALL_READER, so that each has its own time and its own corpus; a magic number is put in its
// place. Without a reader the content decides, and what Zstandard packs reads as it does unpacked.
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hil/replay/formats/byte_record.hpp"
#include "hil/replay/recordings/lcm_recording.hpp"
#include "hil/replay/recordings/mcap_recording.hpp"
#include "hil/replay/recordings/merge.hpp"
#include "hil/replay/recordings/receiver_stream.hpp"
#include "hil/replay/recordings/recording_reader.hpp"
#include "hil/replay/recordings/sqlite_bag.hpp"
#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/vocabulary/check.hpp"

#ifndef PITWALL_READER
#define PITWALL_READER read_recording
#endif

namespace {

using namespace pitwall;
using namespace pitwall::traffic;

constexpr auto kReader = [](const std::string& file) { return PITWALL_READER(file, "f"); };
#define PITWALL_TEXT(name) #name
#define PITWALL_NAME(name) PITWALL_TEXT(name)
constexpr std::string_view kName = PITWALL_NAME(PITWALL_READER);

// What a file of this reader has to begin with.
std::string_view magic() {
  constexpr std::string_view kMcap{"\x89MCAP0\r\n", 8}, kSqlite{"SQLite format 3\0", 16};
  if (kName == "read_mcap") return kMcap;
  return kName == "read_sqlite_bag" ? kSqlite : std::string_view{};
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

std::string packed(const std::string& file) {
  std::string out(ZSTD_compressBound(file.size()), '\0');
  const std::size_t size = ZSTD_compress(out.data(), out.size(), file.data(), file.size(), 1);
  CHECK(ZSTD_isError(size) == 0);
  out.resize(size);
  return out;
}

void check_packed(const std::string& file, const Result<Recording, Problem>& plain) {
  if (file.starts_with("\x28\xB5\x2F\xFD")) return;  // packed twice is refused
  const auto unpacked = read_recording(packed(file), "f");
  CHECK(plain.has_value() == unpacked.has_value());
  if (plain)
    CHECK(unpacked->records.size() == plain->records.size() && check(*unpacked) == check(*plain));
}

// Messages of a NovAtel receiver with good checksums: what comes between two of them, their time
// and whether it is known are taken from the bytes.
std::string novatel_stream(std::string_view bytes) {
  constexpr std::size_t kEach = 8;
  std::string out;
  for (; bytes.size() >= kEach; bytes.remove_prefix(kEach)) {
    const replay::ByteRecord record{bytes};
    gnss::NovatelHeader header;
    header.week = record.u16(0);
    header.milliseconds = record.u32(2);
    header.time_status = record.u8(6);
    std::array<std::uint8_t, gnss::kMaxEncodedBytes> frame{};
    const std::size_t size = gnss::encode(header, gnss::BestPos{}, frame);
    out.append(bytes, 0, record.u8(7) % kEach);
    out.append(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
  }
  return out;
}

void check_file(const std::string& file) {
  auto once = kReader(file);
  auto again = kReader(file);
  CHECK(once.has_value() == again.has_value());
  if (kName == "read_recording") check_packed(file, once);
  if (!once) {
    CHECK(!once.error().what.empty());
    return;
  }
  const std::uint64_t sum = check(*once);
  const std::size_t records = once->records.size();
  std::vector<MergeInput> inputs;
  inputs.push_back({*std::move(once), "a", seconds(1)});
  inputs.push_back({*std::move(again), "b", {}});
  const auto merged = merge(std::move(inputs));
  CHECK(merged.has_value() && merged->records.size() == 2 * records && check(*merged) == 2 * sum);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::string file{reinterpret_cast<const char*>(bytes), size};
  file.replace(0, magic().size(), magic());
  check_file(file);
  if (kName == "read_receiver_stream") check_file(novatel_stream(file));
  return 0;
}
