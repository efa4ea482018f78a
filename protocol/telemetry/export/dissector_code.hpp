// Lua code of the dissector that does not depend on the registry; Lua 5.2, as in Wireshark.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/header.hpp"

namespace pitwall::telemetry {

static_assert(kKinds == 6 && kRecordTypeMax == 12, "names in the dissector are out of date");

inline constexpr std::string_view kDissectorHead = R"(-- Pitwall telemetry, made from its registry.
-- SPDX-License-Identifier: Apache-2.0
)";

inline constexpr std::string_view kDissectorCode = R"lua(
local KINDS = {[0] = "opening", "answer", "newer stamp", "sealed", "signed", "unknown session"}
local RECORDS = {"command", "command result", "command result ack", "event", "event ack", "bulk",
  "bulk ack", "schema", "schema group", "path probe", "path proof", "path receipt"}

local pitwall = Proto("pitwall", "Pitwall telemetry")
local f = {
  version = ProtoField.uint8("pitwall.version", "Version"),
  kind = ProtoField.uint8("pitwall.kind", "Kind", base.DEC, KINDS),
  phase = ProtoField.uint8("pitwall.key_phase", "Key phase"),
  receiver = ProtoField.uint16("pitwall.receiver", "Receiver", base.HEX),
  sequence = ProtoField.uint32("pitwall.sequence", "Sequence (low half)"),
  sealed = ProtoField.bytes("pitwall.sealed", "Sealed body"),
  exchange = ProtoField.bytes("pitwall.exchange", "Key exchange"),
  tag = ProtoField.bytes("pitwall.tag", "Tag"),
  time = ProtoField.double("pitwall.tx_time", "Sent at [s]"),
  paths = ProtoField.uint8("pitwall.paths", "Sent on paths", base.HEX),
  ack_newest = ProtoField.uint16("pitwall.ack.newest", "Newest heard (low 16 bits)"),
  ack_mask = ProtoField.uint32("pitwall.ack.mask", "Heard before it", base.HEX),
  ack_hold = ProtoField.double("pitwall.ack.hold", "Held for [ms]"),
  record = ProtoField.uint8("pitwall.record", "Record", base.DEC, RECORDS),
  payload = ProtoField.bytes("pitwall.record.payload", "Payload"),
}
local e_short = ProtoExpert.new("pitwall.short", "Ends before its time",
  expert.group.MALFORMED, expert.severity.ERROR)
local e_code = ProtoExpert.new("pitwall.code", "A pattern that no value makes",
  expert.group.MALFORMED, expert.severity.ERROR)
pitwall.experts = {e_short, e_code}

local function split(labels)
  local list, number = {}, 0
  for label in labels:gmatch("[^|]+") do
    list[number] = label
    number = number + 1
  end
  return list
end

local all = {}
for _, field in pairs(f) do all[#all + 1] = field end
for _, groups in ipairs({DOWN, UP}) do
  for _, group in ipairs(groups) do
    group.age = ProtoField.double("pitwall.age." .. group.name,
      "Age of the sample, at most [ms]")
    all[#all + 1] = group.age
    for _, field in ipairs(group.fields) do
      local unit = field[2] ~= "" and " [" .. field[2] .. "]" or ""
      field.proto = ProtoField.double("pitwall." .. group.name .. "." .. field[1], field[1] .. unit)
      field.labels = field[7] and split(field[7])
      all[#all + 1] = field.proto
    end
  end
end
pitwall.fields = all
pitwall.prefs.base_port = Pref.uint("Port of the base", BASE_PORT, "what goes to it is the car's")
pitwall.prefs.key_log = Pref.string("Key log", "", "file of pitwall-base --key-log")

-- The bytes that hold these bits of the part of the packet.
local function covering(part, at, bits)
  local first, last = math.floor(at / 8), math.floor((at + bits - 1) / 8)
  return part(first, last - first + 1)
end

local function show_field(tree, part, at, field)
  local bits, count = field[5], field[6]
  local code = part:bitfield(at, bits)
  local bytes = covering(part, at, bits)
  if code == 2 ^ bits - 1 then
    tree:add(bytes, field[1] .. ": unset")
  elseif code >= count then
    tree:add_proto_expert_info(e_code, field[1] .. ": a pattern that no value makes")
  else
    local item = tree:add(field.proto, bytes, field[3] + code * field[4])
    local label = field.labels and field.labels[code]
    if label then item:append_text(" (" .. label .. ")") end
  end
  return at + bits
end

-- Set, ages and values; gives where the records begin, or nothing.
local function show_groups(tree, body, at, groups)
  local set_bytes = math.floor((#groups + 7) / 8)
  if at + set_bytes > body:len() then return end
  local present, bits = {}, 0
  for k, group in ipairs(groups) do
    local byte = body(at + math.floor((k - 1) / 8), 1):uint()
    if math.floor(byte / 2 ^ ((k - 1) % 8)) % 2 == 1 then
      present[#present + 1] = group
      bits = bits + AGE_BITS + group.bits
    end
  end
  at = at + set_bytes
  local size = math.floor((bits + 7) / 8)
  if size == 0 or at + size > body:len() then return end
  local part, bit, branches = body(at, size), 0, {}
  for k, group in ipairs(present) do
    branches[k] = tree:add(part, group.name)
    local code = part:bitfield(bit, AGE_BITS)
    local where = covering(part, bit, AGE_BITS)
    if code == NEVER then
      branches[k]:add(where, "never sampled")
    else
      branches[k]:add(group.age, where, AGES[code + 1])
    end
    bit = bit + AGE_BITS
  end
  for k, group in ipairs(present) do
    for _, field in ipairs(group.fields) do bit = show_field(branches[k], part, bit, field) end
  end
  return at + size
end

local function show_records(tree, body, at)
  while at < body:len() do
    if at + 2 > body:len() then return end
    local length, head = body(at + 1, 1):uint(), 2
    if length >= 0xF0 then
      if at + 3 > body:len() then return end
      length, head = (length - 0xF0) * 256 + body(at + 2, 1):uint(), 3
    end
    if at + head + length > body:len() then return end
    local item = tree:add(f.record, body(at, 1))
    if length > 0 then item:add(f.payload, body(at + head, length)) end
    at = at + head + length
  end
  return at
end

local function show_body(tree, body, groups)
  if body:len() < 4 then return end
  local flags, at = body(3, 1):uint(), 4
  tree:add(f.time, body(0, 3), body(0, 3):le_uint() / 10000)
  tree:add(f.paths, body(3, 1), math.floor(flags / 4) % 2 ^ PATHS)
  if flags % 2 == 1 then
    if at + 8 > body:len() then return end
    tree:add_le(f.ack_newest, body(at, 2))
    tree:add_le(f.ack_mask, body(at + 2, 4))
    tree:add(f.ack_hold, body(at + 6, 2), body(at + 6, 2):le_uint() / 10)
    at = at + 8
  end
  if math.floor(flags / 2) % 2 == 1 then
    at = show_groups(tree, body, at, groups)
    if not at then return end
  end
  return show_records(tree, body, at)
end

local function show_header(tree, buffer)
  local first = buffer(0, 1):uint()
  tree:add(f.version, buffer(0, 1), math.floor(first / 32))
  tree:add(f.kind, buffer(0, 1), math.floor(first / 4) % 8)
  tree:add(f.phase, buffer(0, 1), math.floor(first / 2) % 2)
  tree:add_le(f.receiver, buffer(1, 2))
  tree:add_le(f.sequence, buffer(3, 4))
end

function pitwall.dissector(buffer, info, root)
  if buffer:len() < HEADER then return 0 end
  local first = buffer(0, 1):uint()
  local kind = math.floor(first / 4) % 8
  if math.floor(first / 32) ~= VERSION or not KINDS[kind] or first % 2 ~= 0 then return 0 end
  info.cols.protocol = "PITWALL"
  local down = info.dst_port == pitwall.prefs.base_port
  info.cols.info = (down and "car: " or "base: ") .. KINDS[kind]
  local tree = root:add(pitwall, buffer())
  show_header(tree, buffer)
  local rest = buffer:len() - HEADER
  if KINDS[kind] ~= "sealed" and kind ~= SIGNED then
    if rest > 0 then tree:add(f.exchange, buffer(HEADER, rest)) end
    return buffer:len()
  end
  if rest < TAG then
    tree:add_proto_expert_info(e_short)
    return buffer:len()
  end
  tree:add(f.tag, buffer(buffer:len() - TAG, TAG))
  if rest == TAG then return buffer:len() end
  local body = buffer(HEADER, rest - TAG):tvb()
  if kind ~= SIGNED then
    local plain = open_sealed(pitwall.prefs.key_log, buffer():raw(), buffer(1, 2):le_uint(),
      math.floor(first / 2) % 2, buffer(3, 4):le_uint())
    if not plain then
      tree:add(f.sealed, buffer(HEADER, rest - TAG))
      return buffer:len()
    end
    tree:append_text(", opened by the key log")
    body = ByteArray.new(plain, true):tvb("Opened")
  end
  if not show_body(tree, body, down and DOWN or UP) then
    tree:add_proto_expert_info(e_short)
  end
  return buffer:len()
end

local ports = DissectorTable.get("udp.port")
local registered = BASE_PORT
ports:add(registered, pitwall)
function pitwall.prefs_changed()
  ports:remove(registered, pitwall)
  registered = pitwall.prefs.base_port
  ports:add(registered, pitwall)
end
)lua";

}  // namespace pitwall::telemetry
