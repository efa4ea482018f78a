// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/console_files.hpp"

#include <zlib.h>

#include <array>
#include <optional>
#include <system_error>
#include <utility>

#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kTypes{
    {{".html", "text/html; charset=utf-8"},
     {".js", "text/javascript; charset=utf-8"},
     {".css", "text/css; charset=utf-8"},
     {".json", "application/json"},
     {".svg", "image/svg+xml"},
     {".png", "image/png"},
     {".ico", "image/x-icon"},
     {".woff2", "font/woff2"},
     {".map", "application/json"},
     {".txt", "text/plain; charset=utf-8"}}};

}  // namespace

std::string_view type_of(const fs::path& path) {
  const std::string extension = path.extension().string();
  for (const auto& [end, type] : kTypes)
    if (extension == end) return type;
  return "application/octet-stream";
}

std::string gzip(std::string_view bytes) {
  constexpr int kWindowAndGzip = 15 + 16, kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindowAndGzip, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    return {};
  }
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  std::string in{bytes};  // zlib's own interface is not const
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const bool done = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  out.resize(done ? stream.total_out : 0);
  deflateEnd(&stream);
  return out;
}

const ServedFile* ConsoleFiles::find(std::string_view path) {
  if (path == "/" || path == "/index.html") {
    read_if_new();
    path = "/";
  }
  const auto found = files_.find(path);
  return found != files_.end() ? &found->second : nullptr;
}

void ConsoleFiles::read_if_new() {
  std::error_code none;
  const auto written = fs::last_write_time(folder_ / "index.html", none);
  if (none) {
    files_.clear();
    read_at_ = {};
    return;
  }
  if (written == read_at_) return;
  files_.clear();
  read_at_ = written;
  auto entries = fs::recursive_directory_iterator(folder_, none);
  for (; !none && entries != fs::recursive_directory_iterator(); entries.increment(none)) {
    const fs::path& path = entries->path();
    if (!entries->is_regular_file(none) || entries->is_symlink(none)) continue;
    if (path.extension() == ".gz" || files_.size() >= kFilesMax) continue;
    read(path, "/" + path.lexically_relative(folder_).generic_string());
  }
}

void ConsoleFiles::read(const fs::path& path, const std::string& name) {
  auto bytes = transport::read_file(path.string(), kFileMax);
  if (!bytes) return;
  std::error_code none;
  const fs::path beside = path.string() + ".gz";
  auto made = fs::exists(beside, none) ? transport::read_file(beside.string(), kFileMax)
                                       : Result<std::string, Problem>{gzip(*bytes)};
  ServedFile file{.bytes = nullptr, .gzipped = nullptr, .type = type_of(path)};
  if (made && !made->empty() && made->size() < bytes->size()) {
    file.gzipped = std::make_shared<const std::string>(*std::move(made));
  }
  file.bytes = std::make_shared<const std::string>(*std::move(bytes));
  file.forever = name.starts_with("/assets/");
  files_.insert_or_assign(name == "/index.html" ? "/" : name, std::move(file));
}

}  // namespace pitwall::publishers::web
