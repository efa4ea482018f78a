// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/frames/database_files.hpp"

#include <algorithm>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::replay {
namespace {

Result<can::Manifest, Problem> read_manifest(const std::string& file) {
  const auto text = transport::read_file(file);
  if (!text) return Unexpected{text.error()};
  return can::parse_manifest(*text, file);
}

std::string beside(const std::string& file, const std::string& name) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? name : file.substr(0, slash + 1) + name;
}

SendingNode& node_of(std::vector<SendingNode>& nodes, const std::string& name) {
  const auto known = std::ranges::find(nodes, name, &SendingNode::name);
  if (known != nodes.end()) return *known;
  nodes.push_back({.name = name});
  return nodes.back();
}

// Those that send something, in the order of their messages.
std::vector<SendingNode> nodes_of(const can::Database& database) {
  std::vector<SendingNode> nodes;
  for (const can::Message& message : database.messages) {
    const MessageId id{.id = message.id, .extended = message.extended};
    if (!message.sender.empty()) node_of(nodes, message.sender).messages.push_back(id);
    for (const std::string& other : message.other_senders)
      if (other != message.sender) node_of(nodes, other).messages.push_back(id);
  }
  return nodes;
}

}  // namespace

Result<RestampRules, Problem> load_restamp_rules(const std::string& manifest_file,
                                                 const std::string& dbc_file) {
  const auto manifest = read_manifest(manifest_file);
  if (!manifest) return Unexpected{manifest.error()};
  const std::string path = dbc_file.empty() ? beside(manifest_file, manifest->database) : dbc_file;
  const auto text = transport::read_file(path);
  if (!text) return Unexpected{text.error()};
  const auto database = can::parse_dbc(*text, path);
  if (!database) return Unexpected{database.error()};
  return RestampRules::make(*manifest, *database);
}

Result<std::vector<SendingNode>, Problem> load_nodes(const std::string& dbc_file,
                                                     std::span<const std::string> left_out) {
  const auto text = transport::read_file(dbc_file);
  if (!text) return Unexpected{text.error()};
  const auto database = can::parse_dbc_leniently(*text, dbc_file);
  if (!database) return Unexpected{database.error()};
  std::vector<SendingNode> nodes = nodes_of(*database);
  std::string known;
  for (const SendingNode& node : nodes) known += (known.empty() ? "" : ", ") + node.name;
  for (const std::string& name : left_out) {
    const auto node = std::ranges::find(nodes, name, &SendingNode::name);
    if (node == nodes.end())
      return refuse("--overlay " + name, "no message of " + dbc_file +
                                             " has this sender; expected one of: " +
                                             (known.empty() ? "there are none" : known));
    node->is_left_out = true;
  }
  return nodes;
}

Result<std::string, Problem> database_of(const std::string& manifest_file) {
  const auto manifest = read_manifest(manifest_file);
  if (!manifest) return Unexpected{manifest.error()};
  return beside(manifest_file, manifest->database);
}

}  // namespace pitwall::replay
