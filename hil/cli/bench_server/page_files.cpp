// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/page_files.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench_server {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kRuns = "runs/", kSweeps = "sweeps/", kPage = "/report.html";
constexpr std::string_view kPageEnding = ".html";

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

bool is_page_name(std::string_view page) {
  if (page.size() > kNameMax || !page.ends_with(kPageEnding)) return false;
  if (!page.starts_with(kRuns) && !page.starts_with(kSweeps)) return false;
  while (true) {
    const std::string_view part = page.substr(0, page.find('/'));
    if (part.empty() || part.starts_with('.') || !std::ranges::all_of(part, is_name_character))
      return false;
    if (part.size() == page.size()) return true;
    page.remove_prefix(part.size() + 1);
  }
}

bool is_below(const fs::path& folder, const fs::path& file) {
  return std::ranges::mismatch(folder, file).in1 == folder.end();
}

// The file of a page, without symbolic links.
Result<std::string, Problem> file_of(const PageFolders& folders, std::string_view page) {
  const auto refused = [&](std::string why) {
    return Unexpected{Problem{"page " + std::string{page.substr(0, kNameMax)}, std::move(why)}};
  };
  if (!is_page_name(page)) return refused("expected runs/NAME or sweeps/NAME with a page's path");
  const bool of_run = page.starts_with(kRuns);
  page.remove_prefix(of_run ? kRuns.size() : kSweeps.size());
  std::error_code error;
  const fs::path folder = fs::canonical(of_run ? folders.runs : folders.sweeps, error);
  const fs::path file = error ? fs::path{} : fs::canonical(folder / page, error);
  if (error) return refused("no such page");
  if (!is_below(folder, file)) return refused("leads out of the folder of the pages");
  if (!fs::is_regular_file(file, error) || error) return refused("is not a file");
  if (fs::file_size(file, error) > kMaxPageBytes || error)
    return refused("larger than " + std::to_string(kMaxPageBytes) + " bytes");
  return file.string();
}

// Where the part from `from` ends: between two characters of UTF-8.
std::size_t end_of_part(std::string_view text, std::size_t from) {
  constexpr std::size_t kMaxCharacterBytes = 4;
  const std::size_t end = from + std::min(text.size() - from, kMaxPartBytes);
  if (end == text.size()) return end;
  const auto continues = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  for (std::size_t back = 0; back < kMaxCharacterBytes; ++back)
    if (!continues(end - back)) return end - back;
  return end;  // not UTF-8
}

}  // namespace

std::string page_of_run(std::string_view folder) {
  return std::string{kRuns}.append(folder).append(kPage);
}

std::string page_of_sweep(std::string_view folder) {
  return std::string{kSweeps}.append(folder).append(kPage);
}

bool has_page(const PageFolders& folders, std::string_view page) {
  return file_of(folders, page).has_value();
}

Result<std::string, Problem> page_line(const PageFolders& folders, const PageRequest& request) {
  const auto file = file_of(folders, request.page);
  if (!file) return Unexpected{file.error()};
  const auto text = transport::read_file(*file, kMaxPageBytes);
  if (!text) return Unexpected{text.error()};
  if (request.from > text->size())
    return Unexpected{
        Problem{"page " + request.page, "has no byte " + std::to_string(request.from)}};
  const std::size_t end = end_of_part(*text, request.from);
  return json::Object{}
      .text("type", "page")
      .text("page", request.page)
      .number("from", request.from)
      .number("next", end)
      .number("bytes", text->size())
      .text("text", std::string_view{*text}.substr(request.from, end - request.from))
      .str();
}

}  // namespace pitwall::bench_server
