// Lua code of the dissector that decrypts sealed packets of the bench with the keys of a key log
// (protocol/telemetry/session/key_log.hpp); Lua 5.2 and later, arithmetic in doubles.
//   source RFC 8439 (ChaCha20-Poly1305); the multiplication modulo 2^130 - 5 on bytes, whose sums
//          stay far below 2^53, follows TweetNaCl (Bernstein et al., 2014)
//   invariants
//          a packet is shown as opened only if its tag is valid: a wrong key shows nothing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace pitwall::telemetry {

inline constexpr std::string_view kDissectorCipher = R"lua(
local TURN = 4294967296
local xor = (bit32 or bit or load("return {bxor = function(a, b) return a ~ b end}")()).bxor

local function rotated(x, n)
  x = x * 2 ^ n
  return x % TURN + math.floor(x / TURN)
end

local function quarter(s, a, b, c, d)
  s[a] = (s[a] + s[b]) % TURN
  s[d] = rotated(xor(s[d], s[a]) % TURN, 16)
  s[c] = (s[c] + s[d]) % TURN
  s[b] = rotated(xor(s[b], s[c]) % TURN, 12)
  s[a] = (s[a] + s[b]) % TURN
  s[d] = rotated(xor(s[d], s[a]) % TURN, 8)
  s[c] = (s[c] + s[d]) % TURN
  s[b] = rotated(xor(s[b], s[c]) % TURN, 7)
end

-- 64 bytes of the key stream.
local function chacha_block(key, counter, number)
  local first = {0x61707865, 0x3320646e, 0x79622d32, 0x6b206574}
  for i = 0, 7 do
    local a, b, c, d = key:byte(4 * i + 1, 4 * i + 4)
    first[5 + i] = a + b * 0x100 + c * 0x10000 + d * 0x1000000
  end
  first[13], first[14], first[15], first[16] = counter, 0, number, 0
  local s = {}
  for i = 1, 16 do s[i] = first[i] end
  for _ = 1, 10 do
    quarter(s, 1, 5, 9, 13)
    quarter(s, 2, 6, 10, 14)
    quarter(s, 3, 7, 11, 15)
    quarter(s, 4, 8, 12, 16)
    quarter(s, 1, 6, 11, 16)
    quarter(s, 2, 7, 12, 13)
    quarter(s, 3, 8, 9, 14)
    quarter(s, 4, 5, 10, 15)
  end
  local out = {}
  for i = 1, 16 do
    local word = (s[i] + first[i]) % TURN
    for _ = 1, 4 do
      out[#out + 1] = math.floor(word % 256)
      word = math.floor(word / 256)
    end
  end
  return out
end

-- h + c, both of 17 bytes.
local function add_1305(h, c)
  local carry = 0
  for j = 1, 17 do
    carry = carry + h[j] + c[j]
    h[j] = carry % 256
    carry = math.floor(carry / 256)
  end
end

local function multiply_1305(h, r)
  local x, carry = {}, 0
  for i = 1, 17 do
    local sum = 0
    for j = 1, i do sum = sum + h[j] * r[i + 1 - j] end
    for j = i + 1, 17 do sum = sum + h[j] * r[i + 18 - j] * 320 end
    x[i] = sum
  end
  for _ = 1, 2 do
    for j = 1, 16 do
      carry = carry + x[j]
      x[j] = carry % 256
      carry = math.floor(carry / 256)
    end
    carry = carry + x[17]
    x[17] = carry % 4
    carry = 5 * math.floor(carry / 4)
  end
  x[1] = x[1] + carry
  return x
end

-- The tag of a text whose length is a multiple of 16; `key` has 32 bytes.
local function poly1305(key, text)
  local r, h, s = {}, {}, {}
  for j = 1, 16 do
    r[j] = key[j]
    if j % 4 == 0 then r[j] = r[j] % 16 end
    if j % 4 == 1 and j > 1 then r[j] = r[j] - r[j] % 4 end
    s[j] = key[16 + j]
  end
  r[17], s[17] = 0, 0
  for j = 1, 17 do h[j] = 0 end
  for at = 1, #text, 16 do
    local c = {text:byte(at, at + 15)}
    c[17] = 1
    add_1305(h, c)
    h = multiply_1305(h, r)
  end
  local less = {}
  for j = 1, 17 do less[j] = h[j] end
  add_1305(less, {5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 252})
  if less[17] < 128 then h = less end
  add_1305(h, s)
  local tag = {}
  for j = 1, 16 do tag[j] = string.char(h[j]) end
  return table.concat(tag)
end

local function padded(text) return text .. string.rep("\0", -#text % 16) end

local function length_of(text)
  local n = #text
  return string.char(n % 256, math.floor(n / 256) % 256) .. string.rep("\0", 6)
end

-- What was sealed, or nothing where the tag is not this key's.
local function opened_with(key, number, clear, sealed, tag)
  local text = padded(clear) .. padded(sealed) .. length_of(clear) .. length_of(sealed)
  if poly1305(chacha_block(key, 0, number), text) ~= tag then return end
  local plain, stream = {}, nil
  for i = 0, #sealed - 1 do
    if i % 64 == 0 then stream = chacha_block(key, 1 + i / 64, number) end
    plain[i + 1] = string.char(xor(sealed:byte(i + 1), stream[i % 64 + 1]))
  end
  return table.concat(plain)
end

-- The keys of the file, by receiver and phase; read again when it has grown.
local keys, keys_from, keys_size = {}, nil, nil

local function read_keys(path)
  local file = path ~= "" and io.open(path, "r")
  if not file then return end
  local size = file:seek("end")
  if path ~= keys_from or size ~= keys_size then
    keys, keys_from, keys_size = {}, path, size
    file:seek("set")
    for line in file:lines() do
      local receiver, phase, hex = line:match("^CHACHA20_POLY1305 (%x%x%x%x) (%d+) (%x+)%s*$")
      if receiver and #hex == 64 then
        local key = hex:gsub("%x%x", function(byte) return string.char(tonumber(byte, 16)) end)
        local number = tonumber(receiver, 16)
        keys[number] = keys[number] or {}
        table.insert(keys[number], {phase = tonumber(phase), key = key})
      end
    end
  end
  file:close()
end

-- The body of a sealed packet as a string, or nothing. The upper half of the packet's number is not
-- in the header and taken as 0: so many packets no bench sends.
local function open_sealed(path, packet, receiver, phase, number)
  read_keys(path)
  local clear, sealed = packet:sub(1, HEADER), packet:sub(HEADER + 1, -TAG - 1)
  for _, one in ipairs(keys[receiver] or {}) do
    if one.phase % 2 == phase then
      local plain = opened_with(one.key, number, clear, sealed, packet:sub(-TAG))
      if plain then return plain end
    end
  end
end
)lua";

}  // namespace pitwall::telemetry
