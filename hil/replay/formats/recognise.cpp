// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/recognise.hpp"

#include <algorithm>
#include <array>

#include "hil/replay/formats/asc.hpp"
#include "hil/replay/formats/candump.hpp"
#include "hil/replay/formats/text_line.hpp"
#include "hil/replay/formats/trc.hpp"

namespace pitwall::replay {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kSampleLines = 300;
constexpr std::size_t kMostSampleBytes = std::size_t{1} << 20U;  // of a file without line ends
constexpr std::size_t kSampleBytes = 4'096;
constexpr std::size_t kMaxControlShare = 50;  // of a text: one control character in so many bytes

struct Magic {
  std::string_view bytes;
  FileFormat format;
};

constexpr std::array kMagics{
    Magic{"LOGG"sv, FileFormat::kBlf},
    Magic{"\x1F\x8B"sv, FileFormat::kGzip},
    Magic{"\xD4\xC3\xB2\xA1"sv, FileFormat::kPcap},
    Magic{"\xA1\xB2\xC3\xD4"sv, FileFormat::kPcap},
    Magic{"\x4D\x3C\xB2\xA1"sv, FileFormat::kPcap},
    Magic{"\xA1\xB2\x3C\x4D"sv, FileFormat::kPcap},
    Magic{"\x0A\x0D\x0D\x0A"sv, FileFormat::kPcapng},
    Magic{"\x89MCAP0\r\n"sv, FileFormat::kMcap},
    Magic{"\xED\xA1\xDA\x01"sv, FileFormat::kLcm},
    Magic{"SQLite format 3\0"sv, FileFormat::kSqlite},
    Magic{"\xAA\x44\x12"sv, FileFormat::kNovatel},
    Magic{"\xAA\x44\x13"sv, FileFormat::kNovatel},
    Magic{"\xFA"sv, FileFormat::kVectorNav},
    Magic{"MDF     4"sv, FileFormat::kMf4},
    Magic{"UnFinMF 4"sv, FileFormat::kMf4},
    Magic{"MDF     3"sv, FileFormat::kMdf3},
    Magic{"MDF     2"sv, FileFormat::kMdf3},
    Magic{"#ROSBAG V"sv, FileFormat::kRosbag1},
    Magic{"***BUSMASTER"sv, FileFormat::kBusmaster},
    Magic{"\xFF\xFE"sv, FileFormat::kUtf16},
    Magic{"\xFE\xFF"sv, FileFormat::kUtf16},
    Magic{"PK\x03\x04"sv, FileFormat::kZip},
    Magic{"\x28\xB5\x2F\xFD"sv, FileFormat::kZstd},
    Magic{"BZh"sv, FileFormat::kBzip2},
    Magic{"\xFD\x37zXZ\0"sv, FileFormat::kXz},
    Magic{"\x04\x22\x4D\x18"sv, FileFormat::kLz4},
    Magic{"\x7F\x45LF"sv, FileFormat::kElf},
    Magic{"%PDF-"sv, FileFormat::kPdf},
};

struct Description {
  FileFormat format;
  std::string_view name, advice;
};

constexpr std::array kDescriptions{
    Description{FileFormat::kCandump, kCandumpName, ""},
    Description{FileFormat::kAsc, kAscName, ""},
    Description{FileFormat::kBlf, "a Vector BLF log", ""},
    Description{FileFormat::kTrc, kTrcName, ""},
    Description{FileFormat::kPcap, "a pcap capture", ""},
    Description{FileFormat::kPcapng, "a pcapng capture", ""},
    Description{FileFormat::kGzip, "a gzip file", "unpack it twice: a gzip file is inside"},
    Description{FileFormat::kMcap, "an MCAP recording", ""},
    Description{FileFormat::kLcm, "an LCM event log", ""},
    Description{FileFormat::kSqlite, "a SQLite database (a ROS 2 bag?)", ""},
    Description{FileFormat::kNovatel, "a byte stream of a NovAtel receiver", ""},
    Description{FileFormat::kVectorNav, "a byte stream of a VectorNav receiver", ""},
    Description{FileFormat::kMf4, "an ASAM MDF 4 recording (.mf4)",
                "convert it: can_logconvert IN.mf4 OUT.blf of python-can 4.3 or later with "
                "asammdf"},
    Description{FileFormat::kMdf3, "an ASAM MDF recording of version 2 or 3",
                "it holds signals, not frames"},
    Description{FileFormat::kRosbag1, "a ROS 1 bag", "convert it: rosbags-convert of rosbags"},
    Description{FileFormat::kBusmaster, "a BUSMASTER log",
                "convert it: tshark -r IN -w OUT.pcapng"},
    Description{FileFormat::kCsv, "a table (CSV)", "save the log as BLF, ASC or candump instead"},
    Description{FileFormat::kHtml, "a web page (HTML)", "was a page saved instead of the file?"},
    Description{FileFormat::kXml, "an XML document", ""},
    Description{FileFormat::kJson, "a JSON document", ""},
    Description{FileFormat::kUtf16, "a text in UTF-16", "convert it: iconv -f UTF-16 -t UTF-8"},
    Description{FileFormat::kZip, "a ZIP archive", "unpack it: unzip"},
    Description{FileFormat::kZstd, "a zstd file", "unpack it: unzstd"},
    Description{FileFormat::kBzip2, "a bzip2 file", "unpack it: bunzip2"},
    Description{FileFormat::kXz, "an xz file", "unpack it: unxz"},
    Description{FileFormat::kLz4, "an lz4 file", "unpack it: unlz4"},
    Description{FileFormat::kElf, "a program", ""},
    Description{FileFormat::kPdf, "a PDF document", ""},
    Description{FileFormat::kDbc, "a CAN database (DBC)", "pitwall-hil dbc reads these"},
    Description{FileFormat::kEmpty, "an empty file", ""},
    Description{FileFormat::kUnknownText, "a text of no known format", ""},
    Description{FileFormat::kUnknownBinary, "binary data of no known format", ""},
};

const Description& description_of(FileFormat format) {
  return *std::find_if(kDescriptions.begin(), kDescriptions.end(),
                       [&](const Description& d) { return d.format == format; });
}

// The text format that most of the first lines look like; an empty line or a comment is none.
FileFormat format_of_lines(std::string_view text) {
  std::size_t candump = 0, asc = 0, trc = 0;
  TextLines lines(text);
  for (std::size_t i = 0; i < kSampleLines && lines.next(); ++i) {
    candump += looks_like_candump(lines.line());
    asc += looks_like_asc(lines.line());
    trc += looks_like_trc(lines.line());
  }
  const std::size_t most = std::max({candump, asc, trc});
  if (most == 0) return FileFormat::kUnknownText;
  return most == asc ? FileFormat::kAsc : most == trc ? FileFormat::kTrc : FileFormat::kCandump;
}

FileFormat format_of_other_text(std::string_view bytes) {
  TextLines lines(bytes);
  while (lines.next() && is_blank(lines.line())) continue;
  TextLine line{.text = lines.line()};
  line.skip_spaces();
  const std::string_view start = line.text.substr(line.at);
  if (starts_with_word(start, "<!doctype html") || starts_with_word(start, "<html"))
    return FileFormat::kHtml;
  if (start.starts_with("<")) return FileFormat::kXml;
  if (start.starts_with("{") || start.starts_with("[{")) return FileFormat::kJson;
  if (start.starts_with("VERSION \"")) return FileFormat::kDbc;
  return std::count(start.begin(), start.end(), ',') >= 3 ||
                 std::count(start.begin(), start.end(), ';') >= 3
             ? FileFormat::kCsv
             : FileFormat::kUnknownText;
}

bool is_text(std::string_view bytes) {
  const std::string_view sample = bytes.substr(0, kSampleBytes);
  const auto controls = std::count_if(sample.begin(), sample.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
  });
  return static_cast<std::size_t>(controls) * kMaxControlShare <= sample.size();
}

}  // namespace

FileFormat recognise(std::string_view file) {
  if (file.empty()) return FileFormat::kEmpty;
  const std::string_view bytes = file.substr(0, kMostSampleBytes);
  for (const Magic& magic : kMagics)
    if (bytes.starts_with(magic.bytes)) return magic.format;
  const FileFormat by_lines = format_of_lines(bytes);
  if (by_lines != FileFormat::kUnknownText) return by_lines;
  if (is_text(bytes)) return format_of_other_text(bytes);
  const std::string_view sample = bytes.substr(0, kSampleBytes);
  const bool has_sync = sample.find("\xAA\x44\x12") != std::string_view::npos ||
                        sample.find("\xAA\x44\x13") != std::string_view::npos;
  return has_sync ? FileFormat::kNovatel : FileFormat::kUnknownBinary;
}

std::string_view name_of(FileFormat format) { return description_of(format).name; }
std::string_view advice_on(FileFormat format) { return description_of(format).advice; }

std::string_view formats_that_are_read() {
  return "candump logs, Vector ASC and BLF, PEAK TRC, SocketCAN pcap and pcapng, and gzip of each";
}

}  // namespace pitwall::replay
