// What a replay needs of a car's database and manifest, read from their files.
//   in     the path of a manifest, whose database lies beside it unless another one is given; the
//          path of a DBC file; names of nodes
//   out    rules of restamping; the nodes of the database with what they send
//   errors Problem: a file that does not read, a contradiction, a node that the database has not or
//          that sends nothing, with those that send
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hil/replay/frames/frame_filter.hpp"
#include "hil/replay/frames/restamp_rules.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

// `dbc_file` empty: the one that the manifest names, in the manifest's folder.
Result<RestampRules, Problem> load_restamp_rules(const std::string& manifest_file,
                                                 const std::string& dbc_file);

// Read leniently: a message of a flawed database still has its sender. Where a message has more
// than one, each of them sends it.
Result<std::vector<SendingNode>, Problem> load_nodes(const std::string& dbc_file,
                                                     std::span<const std::string> left_out);

// The database of a manifest, as a path.
Result<std::string, Problem> database_of(const std::string& manifest_file);

}  // namespace pitwall::replay
