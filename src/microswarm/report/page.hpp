// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace microswarm {

/// One part of a page: a heading, some text, a table of two or more columns, and pictures.
struct PageSection {
  std::string heading;
  std::string text;
  std::vector<std::vector<std::string>> table;                ///< the first line is the head
  std::vector<std::pair<std::string, std::string>> pictures;  ///< file beside the page, caption
};

/// Writes a self-contained HTML page; pictures are named by files that stand beside it. All text is
/// escaped.
void write_page(const std::filesystem::path& path, const std::string& title,
                const std::vector<PageSection>& sections);

}  // namespace microswarm
