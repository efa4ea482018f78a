// The main of every fuzzer where there is no libFuzzer: fuzz_NAME FOLDER... tries each file of the
// folders as it is, cut short, and with bits turned over; the same copies in every run.
//   in     the folders that seed_folders.sh names
//   out    how many inputs were tried. Where one ends the program, which one it was
//   errors exit code 1: there is no file
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/random.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

namespace fs = std::filesystem;

// Of a seed as many copies of each kind as its length leaves time for.
constexpr std::size_t kMostCopies = 150, kFewestCopies = 5, kBytesOfCopies = 200'000;
constexpr std::size_t kMostBits = 4;  // turned over in one copy

char input_in_words[512];  // read by the signal handler

void name_input(const fs::path& seed, std::string_view change) {
  std::snprintf(input_in_words, sizeof input_in_words, "the input: %s%.*s\n", seed.c_str(),
                static_cast<int>(change.size()), change.data());
}

void on_crash(int signal) {
  static_cast<void>(!write(STDERR_FILENO, input_in_words, std::strlen(input_in_words)));
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// In memory of exactly its size, so that a sanitizer sees a read beyond it.
void try_input(std::string_view input) {
  const auto bytes = std::make_unique<std::uint8_t[]>(input.size());
  std::copy(input.begin(), input.end(), bytes.get());
  LLVMFuzzerTestOneInput(bytes.get(), input.size());
}

void try_cut(const fs::path& seed, std::string_view text, std::size_t size) {
  name_input(seed, ", its first " + std::to_string(size) + " bytes");
  try_input(text.substr(0, size));
}

void try_changed(const fs::path& seed, std::string text, pitwall::Random& random) {
  std::string change = ", bits turned over:";
  for (std::size_t left = 1 + random.below(kMostBits); left > 0; --left) {
    const std::size_t at = random.below(text.size()), bit = random.below(8);
    text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ 1U << bit);
    change += " " + std::to_string(at) + "." + std::to_string(bit);
  }
  name_input(seed, change);
  try_input(text);
}

std::size_t try_seed(const fs::path& seed) {
  std::ifstream file{seed, std::ios::binary};
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  name_input(seed, "");
  try_input(text);
  if (text.empty()) return 1;
  const std::size_t copies = std::clamp(kBytesOfCopies / text.size(), kFewestCopies, kMostCopies);
  pitwall::Random random;
  for (std::size_t i = 0; i < copies; ++i) {
    try_cut(seed, text, random.below(text.size()));
    try_changed(seed, text, random);
  }
  return 1 + 2 * copies;
}

}  // namespace

int main(int count, char** folders) {
  for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV}) {
    std::signal(signal, on_crash);
  }
  std::vector<fs::path> seeds;
  for (const std::string_view folder :
       std::vector<std::string_view>(folders + 1, folders + count)) {
    for (const auto& entry : fs::recursive_directory_iterator{folder}) {
      if (entry.is_regular_file()) seeds.push_back(entry.path());
    }
  }
  std::sort(seeds.begin(), seeds.end());
  std::size_t inputs = 0;
  for (const fs::path& seed : seeds) inputs += try_seed(seed);
  std::printf("%zu seeds, %zu inputs\n", seeds.size(), inputs);
  return seeds.empty() ? 1 : 0;
}
