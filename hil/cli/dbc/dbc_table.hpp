// A CAN database as a table to read: every message with id, length, period and sender, every signal
// with its bits and what they mean, and what the file holds beside that.
//   in      a database of the lenient parser
//   out     lines of UTF-8 text, columns aligned by characters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/can/database.hpp"

namespace pitwall::cli {

// "47 messages, 179 signals, 3 nodes; 2 sections unused; fingerprint 0x...; 3 errors"
std::string summary_of(const can::Database& database);

// A '!' marks a signal that an error is about; the errors of the message follow its signals.
std::string table_of(const can::Message& message);
// All messages, then the sections that decide nothing here and the errors outside of messages.
std::string table_of(const can::Database& database);

}  // namespace pitwall::cli
