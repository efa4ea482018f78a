// Certificate and key of a service with TLS.
//   in     two PEM files: the chain, its own certificate first; the key, readable by its owner only
//   out    a context of OpenSSL: TLS 1.2 and 1.3, no compression, no renegotiation
//   errors Problem with the file; also if key and certificate do not belong together
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
  std::string warning{};  // browsers refuse it: it has expired, or is not valid yet; may be empty
};

Result<TlsContext, Problem> read_tls_files(const std::string& certificate, const std::string& key);

}  // namespace pitwall::publishers::web
