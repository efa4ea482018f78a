// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/receiver_options.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace pitwall::io {
namespace {

TEST(ReceiverOptions, PortsAndLinksSayTheSame) {
  for (const char* words : {"--gnss 1,2", "--receiver 0=udp:1 --receiver 1=udp:2"}) {
    CLI::App app;
    const ReceiverOptions options{app};
    app.parse(words);
    EXPECT_EQ(to_string(options.links()[0]), "udp:127.0.0.1:1");
    EXPECT_EQ(to_string(options.links()[1]), "udp:127.0.0.1:2");
  }
}

TEST(ReceiverOptions, WithoutAnyTheOptionsAreNamed) {
  CLI::App app;
  const ReceiverOptions options{app};
  app.parse("");
  EXPECT_THROW(static_cast<void>(options.links()), CLI::RequiredError);
}

}  // namespace
}  // namespace pitwall::io
