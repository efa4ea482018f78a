// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/sweep_list.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include "protocol/json/json_text.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench_server {
namespace {

namespace fs = std::filesystem;

// Empty for a folder without a whole summary.
std::string row_of(const PageFolders& folders, const fs::path& sweep) {
  const auto text = transport::read_file((sweep / "summary.json").string(), kMaxSummaryBytes);
  if (!text) return {};
  const auto summary = json::JsonValue::parse(*text, "summary");
  if (!summary || !summary->is_object() || summary->text("name").empty()) return {};
  json::Object row;
  row.text("name", summary->text("name")).text("scenario", summary->text("scenario"));
  for (const char* const count : {"cases", "passed", "failed", "contact", "refused", "crashed"}) {
    if (!std::isfinite(summary->number(count))) return {};
    row.number(count, summary->number(count));
  }
  const std::string page = page_of_sweep(sweep.filename().string());
  return row.text("report", (sweep / "report.html").string())
      .json("page", has_page(folders, page) ? json::quoted(page) : "null")
      .str();
}

}  // namespace

std::string sweeps_line(const PageFolders& folders) {
  std::vector<fs::path> sweeps;
  std::error_code error;
  for (fs::directory_iterator at{folders.sweeps, error}, end; !error && at != end;
       at.increment(error))
    if (at->is_directory(error)) sweeps.push_back(at->path());
  std::ranges::sort(sweeps);
  json::Array rows;
  std::size_t listed = 0, bytes = 0;
  for (const fs::path& sweep : sweeps) {
    const std::string row = row_of(folders, sweep);
    bytes += row.size();
    if (row.empty()) continue;
    if (++listed > kMaxSweeps || bytes > kMaxListBytes) break;
    rows.json(row);
  }
  return json::Object{}.text("type", "sweeps").json("sweeps", rows.str()).str();
}

}  // namespace pitwall::bench_server
