// SPDX-License-Identifier: Apache-2.0
// CSV of a probe's logger: the fields do not depend on the pieces in which the bytes come.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/actuation/coils/probe_file.hpp"
#include "microswarm/core/errors/error.hpp"

namespace {

/// The fields of a file that comes in pieces of this size, and whether all of it was taken.
bool read_in(std::string_view text, std::size_t piece, std::vector<Eigen::Vector3d>& fields) {
  using namespace microswarm;
  const std::size_t end = std::min(text.find('\n'), text.size());
  try {
    actuation::ProbeRows rows(text.substr(0, end), "fuzz.csv");
    for (std::size_t at = end + 1; at < text.size(); at += piece)
      rows.take(text.substr(at, piece), fields);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
    return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::vector<Eigen::Vector3d> at_once, in_pieces;
  const bool whole = read_in(text, 1 << 20, at_once);
  if (whole != read_in(text, 3, in_pieces) || at_once != in_pieces) std::abort();
  for (const Eigen::Vector3d& field : at_once)
    if (!(field.cwiseAbs().maxCoeff() <= 1e4)) std::abort();
  return 0;
}
