// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/tls_files.hpp"

#include <gtest/gtest.h>
#include <openssl/ec.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <memory>
#include <string>

#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;

Key new_key() { return {EVP_EC_gen("P-256"), &EVP_PKEY_free}; }

// Writes in PEM by `write`.
template <class Write>
std::string pem(const Write& write) {
  const std::unique_ptr<BIO, decltype(&BIO_free)> bytes{BIO_new(BIO_s_mem()), &BIO_free};
  EXPECT_EQ(write(bytes.get()), 1);
  char* data = nullptr;
  const long size = BIO_get_mem_data(bytes.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

std::string certificate_of(EVP_PKEY* key, long begins_s, long ends_s) {
  const std::unique_ptr<X509, decltype(&X509_free)> it{X509_new(), &X509_free};
  X509_set_pubkey(it.get(), key);
  X509_gmtime_adj(X509_getm_notBefore(it.get()), begins_s);
  X509_gmtime_adj(X509_getm_notAfter(it.get()), ends_s);
  X509_sign(it.get(), key, EVP_sha256());
  return pem([&](BIO* to) { return PEM_write_bio_X509(to, it.get()); });
}

std::string text_of_key(EVP_PKEY* key) {
  return pem([&](BIO* to) {
    return PEM_write_bio_PrivateKey(to, key, nullptr, nullptr, 0, nullptr, nullptr);
  });
}

class TlsFiles : public testing::Test {
 protected:
  void write(const std::string& certificate, const std::string& key, unsigned permissions = 0600) {
    ASSERT_TRUE(transport::write_file(certificate_, certificate));
    ASSERT_TRUE(transport::write_file(key_file_, key, permissions));
  }
  Result<TlsContext, Problem> read() const { return read_tls_files(certificate_, key_file_); }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("tls");
  std::string certificate_ = folder_.path() + "/chain.pem", key_file_ = folder_.path() + "/key.pem";
  Key key_ = new_key();
};

TEST_F(TlsFiles, AKeyAndItsCertificateServeTls12AndLater) {
  write(certificate_of(key_.get(), -60, 3'600), text_of_key(key_.get()));
  const auto tls = read();
  ASSERT_TRUE(tls) << to_string(tls.error());
  EXPECT_EQ(tls->warning, "");
  EXPECT_EQ(SSL_CTX_get_min_proto_version(tls->context.get()), TLS1_2_VERSION);
}

TEST_F(TlsFiles, WhatBrowsersWillRefuseIsSaid) {
  write(certificate_of(key_.get(), -7'200, -3'600), text_of_key(key_.get()));
  EXPECT_NE(read()->warning.find("has expired"), std::string::npos);
  write(certificate_of(key_.get(), 3'600, 7'200), text_of_key(key_.get()));
  EXPECT_NE(read()->warning.find("not valid yet"), std::string::npos);
}

TEST_F(TlsFiles, WhatIsNoKeyOfTheCertificateIsNamed) {
  const std::string good = certificate_of(key_.get(), -60, 3'600), key = text_of_key(key_.get());
  const auto refused_at = [&] {
    const auto tls = read();
    EXPECT_FALSE(tls);
    return tls ? "" : tls.error().place;
  };
  EXPECT_EQ(refused_at(), certificate_) << "no file";
  write("nonsense", key);
  EXPECT_EQ(refused_at(), certificate_);
  write(good, "nonsense");
  EXPECT_EQ(refused_at(), key_file_);
  write(good, text_of_key(new_key().get()));
  EXPECT_EQ(refused_at(), key_file_) << "of another one";
  write(good, key, 0644);
  EXPECT_NE(refused_at().find(key_file_), std::string::npos) << "others may read it";
}

}  // namespace
}  // namespace pitwall::publishers::web
