// pitwall-dbc-generator DBC MANIFEST OUT.hpp: the typed structs and tables of one car's CAN bus.
//   errors  exit 1 and "file:line:column: error: ..." where database or manifest contradict
//           themselves or each other; of the database every error, worst first
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/generator/header_text.hpp"
#include "protocol/can/manifest.hpp"

namespace {

int refuse(const pitwall::Problem& problem) {
  std::fprintf(stderr, "%s\n", pitwall::to_string(problem).c_str());
  return 1;
}

int refuse_all(const pitwall::can::Database& database) {
  for (const pitwall::can::Finding* const f : pitwall::can::worst_first(database)) {
    if (severity_of(f->kind) == pitwall::can::FindingSeverity::kError) refuse({f->place, f->what});
  }
  return 1;
}

pitwall::Result<std::string, pitwall::Problem> text_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return pitwall::Unexpected{pitwall::Problem{path, "cannot open the file"}};
  return std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: pitwall-dbc-generator DBC MANIFEST OUT.hpp\n");
    return 2;
  }
  const auto dbc = text_of(argv[1]), yaml = text_of(argv[2]);
  if (!dbc) return refuse(dbc.error());
  if (!yaml) return refuse(yaml.error());
  const auto database = pitwall::can::parse_dbc_leniently(*dbc, argv[1]);
  if (!database) return refuse(database.error());
  if (pitwall::can::refusal_of(*database)) return refuse_all(*database);
  const auto manifest = pitwall::can::parse_manifest(*yaml, argv[2]);
  if (!manifest) return refuse(manifest.error());
  const std::string name = std::filesystem::path(argv[3]).stem().string();
  const auto text = pitwall::can::header_text(*database, *manifest, name);
  if (!text) return refuse(text.error());
  std::ofstream out(argv[3], std::ios::binary | std::ios::trunc);
  out << *text;
  out.close();
  if (!out) return refuse({argv[3], "cannot write the file"});
  return 0;
}
