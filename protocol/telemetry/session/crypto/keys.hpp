// Provisioned keys: one X25519 pair for each car and each base, and the public key of its peer. A
// key is bound to its role: a car's key does not open what a base's key opens.
//   text   64 hexadecimal digits; files as `pitwall-base keygen` writes them:
//            # a comment
//            role: car            (or base)
//            public: HEX          own
//            secret: HEX          own
//            peer: HEX            the other end's public key
//            use: bench           only in a pair for the bench: its keys may be logged
//   errors Problem with file and line: a line of another form, keys of the other role, a peer key
//          that equals the own one or gives no shared secret, bench keys in a real car. A secret
//          key is never part of a message or a log
//   source RFC 7748 section 6.1 (points of low order)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/telemetry/session/crypto/randomness.hpp"
#include "protocol/telemetry/session/crypto/secret.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kKeySize = 32;
using PublicKey = std::array<std::uint8_t, kKeySize>;

enum class Role : std::uint8_t { kCar, kBase };

struct Identity {
  PublicKey public_key{};
  Secret<kKeySize> secret_key;
};

Identity make_identity(Randomness& randomness);
std::string text_of(const PublicKey& key);
Result<PublicKey, Problem> parse_public_key(std::string_view text, const std::string& place);

// Key file of one end: its role, its own pair, the other end's public key.
struct KeyFile {
  Role role = Role::kCar;
  Identity own;
  PublicKey peer{};
  bool bench = false;  // pair for the bench: its keys may be logged; a real car refuses it
};
inline constexpr std::size_t kMaxKeyFileBytes = 4'096;

// Reader of a key file.
struct KeyUser {
  Role role = Role::kCar;
  bool real_car = false;
};
std::string text_of(const KeyFile& keys);
Result<KeyFile, Problem> parse_key_file(std::string_view text, const std::string& place,
                                        KeyUser user);

}  // namespace pitwall::telemetry
