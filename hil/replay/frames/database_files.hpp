// Loader of the database and manifest of a car for a replay.
//   in     the path of a manifest, whose database is in the same folder unless another one is
//          given; the path of a DBC file; names of nodes
//   out    rules of restamping; the nodes of the database with the messages they send
//   errors Problem: an unreadable file, a contradiction, a node that is not in the database or
//          sends nothing, with the list of sending nodes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hil/replay/frames/frame_filter.hpp"
#include "hil/replay/frames/restamp_rules.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

// `dbc_file` empty: the file that the manifest names, in the folder of the manifest.
Result<RestampRules, Problem> load_restamp_rules(const std::string& manifest_file,
                                                 const std::string& dbc_file);

// Reads leniently: a message of a flawed database still has its sender. If a message has several
// senders, each of them sends it.
Result<std::vector<SendingNode>, Problem> load_nodes(const std::string& dbc_file,
                                                     std::span<const std::string> left_out);

// Path of the database of a manifest.
Result<std::string, Problem> database_of(const std::string& manifest_file);

}  // namespace pitwall::replay
