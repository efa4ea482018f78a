// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/private_access.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <filesystem>
#include <utility>

namespace pitwall::transport {
namespace {

constexpr unsigned kRoot = 0;
constexpr unsigned kPermissions = 07777, kOfOthers = S_IRWXG | S_IRWXO,
                   kWritableByOthers = S_IWGRP | S_IWOTH;

// "0644"
std::string octal(unsigned mode) {
  std::string digits;
  for (unsigned rest = mode & kPermissions; rest != 0 || digits.size() < 4; rest >>= 3U)
    digits.insert(digits.begin(), static_cast<char>('0' + (rest & 7U)));
  return digits;
}

std::optional<Problem> judge_owner(const std::string& path, unsigned owner, unsigned user) {
  if (owner == user || owner == kRoot) return std::nullopt;
  const std::string expected = std::to_string(user);
  return Problem{path, "belongs to user " + std::to_string(owner) + ", expected user " + expected +
                           ", who runs this program" + (user == kRoot ? "" : ", or root") +
                           ": chown " + expected + " " + path};
}

struct Opened {
  FileDescriptor fd;
  struct stat about {};
};

Result<Opened, Problem> open_and_ask(const std::string& path, int flags) {
  const auto made = posix_call([&] { return ::open(path.c_str(), flags | O_CLOEXEC); });
  Opened opened{.fd = FileDescriptor{made}};
  if (made.error == ELOOP && (flags & O_NOFOLLOW) != 0) {
    return Unexpected{
        Problem{path, "is a symbolic link, expected the file itself: name what it points to"}};
  }
  if (!opened.fd.valid()) return Unexpected{Problem{path, made.reason()}};
  const auto asked = posix_call([&] { return ::fstat(opened.fd.get(), &opened.about); });
  if (!asked.ok()) return Unexpected{Problem{path, asked.reason()}};
  return opened;
}

AccessRights rights_of(const struct stat& about) {
  return {.owner = about.st_uid, .mode = about.st_mode};
}

}  // namespace

std::optional<Problem> judge_file(const std::string& path, AccessRights file, unsigned user) {
  if (auto problem = judge_owner(path, file.owner, user)) return problem;
  const unsigned allowed = file.owner == user ? 0U : unsigned{S_IRGRP};
  if ((file.mode & kOfOthers & ~allowed) == 0) return std::nullopt;
  return Problem{path, "has mode " + octal(file.mode) +
                           ", so others may read or change it, expected 0600: chmod 600 " + path +
                           ", and replace the secret"};
}

std::optional<Problem> judge_folder(const std::string& path, AccessRights folder, unsigned user) {
  if (auto problem = judge_owner(path, folder.owner, user)) return problem;
  if ((folder.mode & kWritableByOthers) == 0 || (folder.mode & S_ISVTX) != 0) return std::nullopt;
  return Problem{path, "folder has mode " + octal(folder.mode) +
                           ", so others may replace its files, expected 0755 or less: chmod go-w " +
                           path};
}

std::optional<Problem> check_folder_of(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  const std::string folder = parent.empty() ? "." : parent;
  const auto opened = open_and_ask(folder, O_PATH | O_DIRECTORY);
  if (!opened) return opened.error();
  return judge_folder(folder, rights_of(opened->about), geteuid());
}

Result<FileDescriptor, Problem> open_private(const std::string& path) {
  // Without O_NONBLOCK a pipe would hold the start up.
  auto opened = open_and_ask(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
  if (!opened) return Unexpected{opened.error()};
  if (!S_ISREG(opened->about.st_mode)) {
    return Unexpected{Problem{path, "is a folder, a pipe or a device, expected a file"}};
  }
  if (auto problem = judge_file(path, rights_of(opened->about), geteuid())) {
    return Unexpected{*std::move(problem)};
  }
  if (auto problem = check_folder_of(path)) return Unexpected{*std::move(problem)};
  return std::move(opened->fd);
}

}  // namespace pitwall::transport
