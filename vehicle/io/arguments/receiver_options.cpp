// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/receiver_options.hpp"

#include <CLI/CLI.hpp>

namespace pitwall::io {
namespace {

constexpr const char* kPorts = "--gnss";
constexpr const char* kLinks = "--receiver";

}  // namespace

ReceiverOptions::ReceiverOptions(CLI::App& app) {
  app.add_option(kPorts, ports_, "UDP ports of the two GNSS receivers, e.g. 23501,23502")
      ->delimiter(',')
      ->check(CLI::Range(1, kPortMax))
      ->expected(static_cast<int>(world::kGnssUnits));
  app.add_option(kLinks, words_,
                 "instead of --gnss, once for each receiver: 0= or 1= and udp:[ADDRESS:]PORT, "
                 "tcp:ADDRESS:PORT or serial:/dev/DEVICE[:BAUD]")
      ->expected(1, static_cast<int>(world::kGnssUnits));
}

ReceiverLinks ReceiverOptions::links() const {
  if (words_.empty() && ports_.empty())
    throw CLI::RequiredError("--gnss (the receivers' UDP ports), or --receiver for each of them,");
  const auto links = receiver_links(words_, ports_);
  if (!links)
    throw CLI::ValidationError(words_.empty() ? kPorts : kLinks,
                               links.error().place + ": " + links.error().what);
  return *links;
}

}  // namespace pitwall::io
