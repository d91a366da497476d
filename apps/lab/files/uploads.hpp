// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "lab/files/download.hpp"
#include "lab/files/library.hpp"

namespace microswarm::lab {

/// Result of an upload.
struct Upload {
  enum class Kind { photograph, scenario, record };
  std::string file;  ///< its name in open requests
  Kind kind = Kind::record;
  int width = 0;  ///< of a photograph [px]
  int height = 0;
};
constexpr auto enum_names(Upload::Kind) {
  return std::array<std::pair<Upload::Kind, std::string_view>, 3>{
      {{Upload::Kind::photograph, "photograph"},
       {Upload::Kind::scenario, "scenario"},
       {Upload::Kind::record, "record"}}};
}

/// Maximum size of an upload [B].
inline constexpr std::size_t max_upload = 64 * 1024 * 1024;

/// Uploaded files, in a folder of this lab that is removed at its end. They are named by numbers,
/// so that a page cannot choose a path.
class Uploads {
 public:
  Uploads() : place_("uploads") {}

  std::filesystem::path folder() const { return place_.path().parent_path(); }
  /// Keeps a file whose kind follows from the extension of `name`: a photograph, a scenario whose
  /// files are in `library`, or a record. Throws InputError, and keeps nothing, if it is invalid or
  /// there are too many.
  Upload keep(std::string_view name, const std::string& bytes, const Library& library);
  /// Path of a new file with this extension.
  std::filesystem::path new_file(std::string_view extension);

 private:
  TemporaryFile place_;
  int count_ = 0;
  std::size_t size_ = 0;  ///< total size [B]
};

}  // namespace microswarm::lab
