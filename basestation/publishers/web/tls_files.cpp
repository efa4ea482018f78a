// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/tls_files.hpp"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <array>

#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;
using PrivateKey = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;

// What OpenSSL complained of first.
std::string complaint() {
  const unsigned long code = ERR_get_error();
  ERR_clear_error();
  std::array<char, 160> text{};
  ERR_error_string_n(code, text.data(), text.size());
  const char* const reason = ERR_reason_error_string(code);
  return reason != nullptr ? reason : text.data();
}

// No password is asked for: a base starts without anybody at a keyboard.
int no_password(char*, int, int, void*) { return 0; }

Result<bool, Problem> use_key(SSL_CTX* context, const std::string& file) {
  const auto text = transport::read_private_file(file);
  if (!text) return Unexpected{text.error()};
  const Bio bytes{BIO_new_mem_buf(text->data(), static_cast<int>(text->size())), &BIO_free};
  const PrivateKey key{PEM_read_bio_PrivateKey(bytes.get(), nullptr, no_password, nullptr),
                       &EVP_PKEY_free};
  if (!key) {
    return Unexpected{
        Problem{file, "expected a private key in PEM without a password: " + complaint()}};
  }
  if (SSL_CTX_use_PrivateKey(context, key.get()) != 1) {
    return Unexpected{Problem{file, "is not the key of the certificate: " + complaint()}};
  }
  return true;
}

std::string warning_of(const X509* certificate, const std::string& file) {
  if (certificate == nullptr) return {};
  if (X509_cmp_current_time(X509_get0_notAfter(certificate)) < 0)
    return file + ": this certificate has expired; browsers will refuse it";
  if (X509_cmp_current_time(X509_get0_notBefore(certificate)) > 0)
    return file + ": this certificate is not valid yet; browsers will refuse it";
  return {};
}

}  // namespace

Result<TlsContext, Problem> read_tls_files(const std::string& certificate, const std::string& key) {
  TlsContext tls{.context = {SSL_CTX_new(TLS_server_method()), &SSL_CTX_free}};
  SSL_CTX* const context = tls.context.get();
  if (context == nullptr) return Unexpected{Problem{certificate, complaint()}};
  SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  SSL_CTX_set_options(
      context, SSL_OP_NO_COMPRESSION | SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS);
  if (SSL_CTX_use_certificate_chain_file(context, certificate.c_str()) != 1)
    return Unexpected{Problem{certificate, "expected a certificate in PEM: " + complaint()}};
  const auto used = use_key(context, key);
  if (!used) return Unexpected{used.error()};
  if (SSL_CTX_check_private_key(context) != 1)
    return Unexpected{Problem{key, "is not the key of " + certificate + ": " + complaint()}};
  tls.warning = warning_of(SSL_CTX_get0_certificate(context), certificate);
  return tls;
}

}  // namespace pitwall::publishers::web
