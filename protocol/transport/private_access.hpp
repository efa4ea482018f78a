// Access check of a file that holds a secret: nobody but its user may read, change or replace it.
//   in     path; owner and mode of the file and of its folder; the effective user of the process
//   out    the open file, to be read
//   errors Problem with the file or its folder as place: what was found, what was expected, what to
//          do. The file is no symbolic link and no device; it belongs to the process's user, or to
//          root, who may then let a group read it (so systemd hands credentials over, by an ACL
//          that shows as the group's rights); the folder belongs to either, and nobody else may
//          write it unless it is sticky
//   source OpenSSH 9.2: sshkey_perm_ok() for modes of files, safe_path() for owners and folders
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

inline constexpr unsigned kOwnerOnly = 0600;

// As stat() has them.
struct AccessRights {
  unsigned owner = 0, mode = 0;
};

// Why a process of `user` must not trust file or folder with a secret; nothing where it may.
std::optional<Problem> judge_file(const std::string& path, AccessRights file, unsigned user);
std::optional<Problem> judge_folder(const std::string& path, AccessRights folder, unsigned user);

// The folder in which the file is or shall be, for this process.
std::optional<Problem> check_folder_of(const std::string& path);
Result<FileDescriptor, Problem> open_private(const std::string& path);

}  // namespace pitwall::transport
