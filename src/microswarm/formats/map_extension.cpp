// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/map_extension.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/matrix.hpp"

namespace microswarm::formats {
namespace {

/// First bytes of files of a format.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> beginnings{
    {{"\x89PNG", ".png"},
     {"\xff\xd8", ".jpg"},
     {"BM", ".bmp"},
     {std::string_view("II*\0", 4), ".tif"},
     {std::string_view("MM\0*", 4), ".tif"},
     {"type ", ".map"},
     {"{", ".geojson"},
     {"[", ".geojson"}}};

/// Whether a line of a YAML file sets the key.
bool has_key(std::string_view text, std::string_view key) {
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1))
    if ((at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r') &&
        text.substr(at + key.size()).starts_with(':'))
      return true;
  return false;
}

std::string extension_of(std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) return ".txt";  // of UTF-16
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  for (const auto& [begin, extension] : beginnings)
    if (text.starts_with(begin)) return std::string(extension);
  if (text.size() > 2 && text[0] == 'P' && text[1] >= '1' && text[1] <= '6' && text[2] <= ' ')
    return ".pgm";
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.starts_with('{') || text.starts_with('[')) return ".geojson";
  if (text.starts_with("<svg") || text.starts_with("<?xml")) return ".svg";
  if (has_key(text, "image") && has_key(text, "resolution")) return ".yaml";
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  if (is_matrix(line)) return ".txt";
  return line.find_first_of(",;\t") == std::string_view::npos ? "" : ".csv";
}

}  // namespace

std::string map_extension(const std::filesystem::path& file) {
  const std::string own = lower_extension(file);
  if (!own.empty()) return own;
  constexpr std::size_t enough = 4096;
  return extension_of(read_begin(file, enough));
}

std::string advice_on_no_map(const std::filesystem::path& file) {
  constexpr std::string_view cad[] = {".dxf", ".dwg", ".step", ".stp", ".stl"};
  const std::string extension = lower_extension(file);
  if (std::ranges::find(cad, extension) != std::end(cad)) return "; export the drawing as SVG";
  if (extension != ".svgz" && extension != ".gz") return "";
  const std::string unpacked = file.stem().string() + (extension == ".svgz" ? ".svg" : "");
  return "; unpack it: gunzip < " + file.filename().string() + " > " + unpacked;
}

}  // namespace microswarm::formats
