// Access check of a file with a secret: only its user may read, change or replace it.
//   in     path; owner and mode of the file and of its folder; the effective user of the process
//   out    the file, open for reading
//   errors Problem with the file or its folder as place: what was found, what was expected, what to
//          do. The file must not be a symbolic link or a device. It must belong to the user of the
//          process, or to root; a file of root may be readable by a group (systemd passes
//          credentials with an ACL that appears as rights of the group). The folder must belong to
//          either of them, and others must not have write access unless it is sticky
//   source OpenSSH 9.2: sshkey_perm_ok() for modes of files, safe_path() for owners and folders
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

inline constexpr unsigned kOwnerOnly = 0600;

// Owner and mode as stat() returns them.
struct AccessRights {
  unsigned owner = 0, mode = 0;
};

// Reason why a process of `user` must not keep a secret in the file or folder; empty if it may.
std::optional<Problem> judge_file(const std::string& path, AccessRights file, unsigned user);
std::optional<Problem> judge_folder(const std::string& path, AccessRights folder, unsigned user);

// Checks the folder of an existing or new file, for the user of this process.
std::optional<Problem> check_folder_of(const std::string& path);
Result<FileDescriptor, Problem> open_private(const std::string& path);

}  // namespace pitwall::transport
