// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace microswarm::report {

/// One section of a page: a heading, text, a table with two or more columns, and pictures.
struct PageSection {
  std::string heading{};
  std::string text{};
  std::vector<std::vector<std::string>> table{};                ///< the first row is the header
  std::vector<std::pair<std::string, std::string>> pictures{};  ///< relative file, caption
};

/// Writes an HTML page. Pictures are referenced by file names relative to the page. All text is
/// escaped.
void write_page(const std::filesystem::path& path, const std::string& title,
                const std::vector<PageSection>& sections);

}  // namespace microswarm::report
