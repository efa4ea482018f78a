// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/synthetic_dbc.hpp"

#include <array>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr std::uint64_t kSyntheticSeed = 800;
constexpr unsigned kNodes = 24;
constexpr unsigned kStandardIds = 500;  // the messages behind have 29-bit ids
constexpr std::array<const char*, 6> kUnits{"km/h", "degC", "kPa", "%", "rpm", ""};
constexpr std::array<const char*, 5> kScales{"1", "0.1", "0.01", "0.0625", "-0.5"};

std::string text(std::uint64_t v) { return std::to_string(v); }

class Writer {
 public:
  std::string run(std::size_t least_bytes) {
    std::string head = "VERSION \"1.0\"\n\nNS_ :\n\tCM_\n\tBA_DEF_\n\tBA_\n\tVAL_\n\nBS_:\n\nBU_:";
    for (unsigned n = 0; n < kNodes; ++n) head += " Node" + text(n);
    head += "\n\n";
    while (head.size() + messages_.size() + details_.size() < least_bytes) message();
    return head + messages_ +
           "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n"
           "BA_DEF_ SG_ \"GenSigStartValue\" FLOAT -1e9 1e9;\n"
           "BA_DEF_DEF_ \"GenMsgCycleTime\" 100;\nBA_DEF_DEF_ \"GenSigStartValue\" 0;\n" +
           details_;
  }

 private:
  std::string node() { return "Node" + text(random_.below(kNodes)); }

  void message() {
    const std::uint64_t n = count_++;
    key_ = text(n < kStandardIds ? 0x100 + n : 0x80000000U + 0x18FF0000U + n);
    messages_ += "BO_ " + key_ + " Message_" + text(n) + ": 8 " + node() + "\n";
    details_ += "CM_ BO_ " + key_ + " \"Message number " + text(n) + " of a bus; all made up.\";\n";
    details_ +=
        "BA_ \"GenMsgCycleTime\" BO_ " + key_ + " " + text(10 + 10 * random_.below(10)) + ";\n";
    switch (random_.below(8)) {
      case 0:
        return multiplexed();
      case 1:
        return floats();
      case 2:
        return motorola();
      default:
        return plain();
    }
  }

  void signal(const std::string& name, const std::string& mark, const std::string& place) {
    messages_ += " SG_ " + name + mark + " : " + place + " (" + kScales[random_.below(5)] + "," +
                 text(random_.below(3)) + ") [0|0] \"" + kUnits[random_.below(6)] + "\" " + node() +
                 "," + node() + "\n";
    if (random_.below(2) == 0) {
      details_ +=
          "CM_ SG_ " + key_ + " " + name + " \"What " + name + " stands for, in one line.\";\n";
    }
    if (random_.below(4) == 0) {
      details_ += "BA_ \"GenSigStartValue\" SG_ " + key_ + " " + name + " " +
                  text(random_.below(9)) + ";\n";
    }
    if (random_.below(4) == 0) {
      details_ += "VAL_ " + key_ + " " + name + " 0 \"off or not available\" 1 \"on\" ;\n";
    }
  }

  void plain() {
    for (unsigned bit = 0; bit < 64;) {
      const auto length = static_cast<unsigned>(2 + random_.below(15));
      if (bit + length > 64) break;
      signal("Signal_" + text(bit), "",
             text(bit) + "|" + text(length) + (random_.below(3) == 0 ? "@1-" : "@1+"));
      bit += length;
    }
  }

  void motorola() {
    for (unsigned word = 0; word < 4; ++word) {
      signal("Word_" + text(word), "", text(16 * word + 7) + "|16@0+");
    }
  }

  void floats() {
    for (const char* const place : {"0|32@1-", "32|32@1-"}) {
      const std::string name = place[0] == '0' ? "First" : "Second";
      signal(name, "", place);
      details_ += "SIG_VALTYPE_ " + key_ + " " + name + " : 1;\n";
    }
  }

  void multiplexed() {
    signal("Page", " M", "0|8@1+");
    for (unsigned page = 0; page < 8; ++page) {
      for (unsigned part = 0; part < 3; ++part) {
        signal("Page" + text(page) + "_" + text(part), " m" + text(page),
               text(8 + 16 * part) + "|16@1+");
      }
    }
  }

  Random random_{kSyntheticSeed};
  std::uint64_t count_ = 0;
  std::string key_, messages_, details_;
};

}  // namespace

std::string synthetic_dbc(std::size_t least_bytes) { return Writer{}.run(least_bytes); }

}  // namespace pitwall::benchmarks
