// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "lab/download.hpp"
#include "lab/library.hpp"

namespace microswarm::lab {

/// What an upload became.
struct Upload {
  enum class Kind { photograph, scenario, record };
  std::string file;  ///< its name for open requests
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

/// Largest upload [bytes].
inline constexpr std::size_t max_upload = 64 * 1024 * 1024;

/// Files that pages sent, in a folder of this lab, which is removed at its end. They are named by
/// number, so that a page chooses no path.
class Uploads {
 public:
  Uploads() : place_("uploads") {}

  std::filesystem::path folder() const { return place_.path().parent_path(); }
  /// Keeps a file; the ending of `name` says what it should be: a photograph, a scenario whose
  /// files are in `library`, or a record. Throws InputError if it is none or there are too many;
  /// then nothing is kept.
  Upload keep(std::string_view name, const std::string& bytes, const Library& library);
  /// A new file of this ending.
  std::filesystem::path new_file(std::string_view extension);

 private:
  TemporaryFile place_;
  int count_ = 0;
  std::size_t size_ = 0;  ///< of all [bytes]
};

}  // namespace microswarm::lab
