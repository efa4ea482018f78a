// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/gzip_writer.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "hil/replay/formats/gzip.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::replay {
namespace {

// Nothing, a little, and more than one step of zlib's that does not become smaller.
std::vector<std::string> contents() {
  Random random{.state = 3};
  std::string noise(3'000'000, '\0');
  for (char& byte : noise) byte = static_cast<char>(random.next());
  return {"", "x", std::string(5'000'000, 'x'), noise};
}

TEST(GzipWriter, PythonAndWeUnpackTheSameBytes) {
  const auto folder = transport::TemporaryFolder::create("pitwall-gzip-");
  ASSERT_TRUE(folder);
  const std::string path = folder->path() + "/a";
  for (const std::string& content : contents()) {
    const auto packed = pack_gzip(content);
    ASSERT_TRUE(packed && transport::write_file(path + ".gz", *packed));
    const std::string command =
        "/usr/bin/python3 -c 'import gzip, sys; open(sys.argv[2], \"wb\").write(gzip.open("
        "sys.argv[1]).read())' '" +
        path + ".gz' '" + path + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT: a test
    EXPECT_TRUE(transport::read_file(path).value_or("?") == content) << content.size();
    const Unpacked ours = unpack_gzip(*packed);
    EXPECT_TRUE(ours.bytes == content && ours.problem.empty()) << content.size();
  }
}

TEST(GzipWriter, TheSameBytesGiveTheSameFileAndTextBecomesSmaller) {
  const std::string text(100'000, 'a');
  EXPECT_EQ(pack_gzip(text).value(), pack_gzip(text).value());
  EXPECT_LT(pack_gzip(text)->size(), 1'000U);
}

}  // namespace
}  // namespace pitwall::replay
