// pitwall-dbc-generator DBC MANIFEST OUT.hpp: the typed structs and tables of one car's CAN bus.
//   errors  exit 1 and "file:line:column: error: ..." where database or manifest contradict
//           themselves or each other
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/generator/header_text.hpp"
#include "protocol/can/manifest.hpp"

namespace {

int refuse(const pitwall::Problem& problem) {
  std::fprintf(stderr, "%s\n", pitwall::to_string(problem).c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: pitwall-dbc-generator DBC MANIFEST OUT.hpp\n");
    return 2;
  }
  const auto database = pitwall::can::load_dbc(argv[1]);
  if (!database) return refuse(database.error());
  const auto manifest = pitwall::can::load_manifest(argv[2]);
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
