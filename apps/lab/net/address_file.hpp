// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace microswarm::lab {

/// File that only this user can read, whose page leads to an address with a token: a browser is
/// started with the file, because all users see its command line. Removed with this object.
class AddressFile {
 public:
  /// In the user's runtime folder, XDG_RUNTIME_DIR, or else in the temporary one.
  explicit AddressFile(const std::string& url);
  ~AddressFile();
  AddressFile(const AddressFile&) = delete;
  AddressFile& operator=(const AddressFile&) = delete;

  /// Empty if it could not be written.
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace microswarm::lab
