// SPDX-License-Identifier: Apache-2.0
#include "hil/report/junit.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "protocol/vocabulary/check.hpp"
#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

// What Python's own XML reader says: attributes of the suite, then one line per case.
std::string read_by_python(const std::string& xml) {
  // Tests of this file run beside each other, each in a process of its own.
  const std::string mine = testing::TempDir() + "/junit_" + std::to_string(::getpid());
  const std::string path = mine + ".xml";
  std::ofstream(path) << xml;
  const std::string program =
      "import sys, xml.etree.ElementTree as E\n"
      "s = E.parse(sys.argv[1]).getroot()\n"
      "print(s.tag, s.get('name'), s.get('tests'), s.get('failures'), s.get('errors'))\n"
      "for c in s.findall('testcase'):\n"
      "  print(c.get('name'), [(i.tag, i.get('message')) for i in c])\n";
  const std::string script = mine + ".py";
  std::ofstream(script) << program;
  std::FILE* pipe = popen(("/usr/bin/python3 '" + script + "' '" + path + "' 2>&1").c_str(), "r");
  CHECK(pipe != nullptr);
  std::string out;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) out += part.data();
  EXPECT_EQ(pclose(pipe), 0) << out;
  std::filesystem::remove(path);
  std::filesystem::remove(script);
  return out;
}

TEST(Junit, OneCaseForEachExpectation) {
  EXPECT_EQ(read_by_python(junit_xml(run_of({.with_failure = true}))),
            "testsuite pitwall.some_run.lockstep 2 1 0\n"
            "always speed_mps > 1, from 1 s []\n"
            "never abs_cross_track_m > 2 [('failure', '2.75 at 6.5 s; first violated at 6.500 s; "
            "margin -0.75')]\n");
}

TEST(Junit, AFailedBenchIsAnErrorAndNotAFailure) {
  const std::string read = read_by_python(junit_xml(run_of({.close = false})));
  EXPECT_TRUE(read.starts_with("testsuite pitwall.some_run.lockstep 2 0 1\n")) << read;
  EXPECT_EQ(count(read, "('error', 'events.mcap: truncated at byte"), 1u) << read;
}

TEST(Junit, WhatWasNotJudgedIsAnErrorWithItsSentence) {
  RunData run = run_of({});
  std::string result = result_of(run);
  const std::string none = "\"not_judged\": []";
  result.replace(result.find(none), none.size(), "\"not_judged\": [\"car b missed 3 %\"]");
  add_result(run, result, "run.json");
  const std::string read = read_by_python(junit_xml(run));
  EXPECT_TRUE(read.starts_with("testsuite pitwall.some_run.lockstep 2 0 1\n")) << read;
  EXPECT_EQ(count(read, "('error', 'run.json: not judged: car b missed 3 %')"), 1u) << read;
}

TEST(Junit, NoNameBreaksTheFile) {
  const std::string evil = "a\"b'<c>&\x01\x1f\x7f\xff]]>\xEF\xBF\xBE";
  const std::string read = read_by_python(junit_xml(run_of({.scenario = evil, .mode = evil})));
  EXPECT_EQ(count(read, "a\"b'<c>&"), 2u) << read;
}

TEST(Junit, CountsFollowTheOutcome) {
  for (const bool failed : {false, true})
    for (const bool closed : {false, true}) {
      const RunData run = run_of({.with_failure = failed, .close = closed});
      const std::string xml = junit_xml(run);
      const bool clean = count(xml, " failures=\"0\" errors=\"0\"") == 1;
      EXPECT_EQ(clean, run.outcome() == Outcome::kPass);
      EXPECT_EQ(count(xml, "<failure "), failed ? 1u : 0u);
      EXPECT_EQ(count(xml, "<error "), closed ? 0u : 1u);
    }
}

}  // namespace
}  // namespace pitwall::report
