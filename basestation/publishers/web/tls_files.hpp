// The certificate and the key of a service that speaks TLS.
//   in     two files in PEM: the chain, its own certificate first; the key, for its owner only
//   out    what OpenSSL serves with: TLS 1.2 and 1.3, no compression, no renegotiation
//   errors Problem with the file; that key and certificate do not belong together
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

struct ssl_ctx_st;

namespace pitwall::publishers::web {

struct TlsContext {
  std::shared_ptr<ssl_ctx_st> context{};
  std::string warning{};  // what browsers will say of it: it has expired, or is not yet valid
};

Result<TlsContext, Problem> read_tls_files(const std::string& certificate, const std::string& key);

}  // namespace pitwall::publishers::web
