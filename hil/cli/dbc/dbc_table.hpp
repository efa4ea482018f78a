// CAN database as a text table: every message with identifier, length, period and sender, every
// signal with its bits and their meaning, and the remaining contents of the file.
//   in      a database of the lenient parser
//   out     lines of UTF-8 text, columns aligned by characters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/can/database.hpp"

namespace pitwall::cli {

// "47 messages, 179 signals, 3 nodes; 2 sections unused; fingerprint 0x...; 3 errors"
std::string summary_of(const can::Database& database);

// A '!' marks a signal with an error; the errors of the message follow its signals.
std::string table_of(const can::Message& message);
// All messages, then the unused sections and the errors outside of messages.
std::string table_of(const can::Database& database);

}  // namespace pitwall::cli
