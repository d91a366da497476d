// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/page.hpp"

#include <fmt/format.h>

#include "microswarm/core/text/file.hpp"
#include "microswarm/report/html.hpp"

namespace microswarm::report {
namespace {

constexpr const char* style = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #20252b; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2.2rem; }
table { border-collapse: collapse; } th, td { text-align: left; padding: .25rem 1.2rem .25rem 0; border-bottom: 1px solid #ddd; }
th { font-weight: 600; } td { font-variant-numeric: tabular-nums; }
figure { margin: 1rem 0; } img { max-width: 100%; border: 1px solid #ddd; } figcaption { color: #555; }
)";

std::string html_table(const std::vector<std::vector<std::string>>& lines) {
  std::string out = "<table>\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    out += "<tr>";
    for (const std::string& cell : lines[i])
      out += fmt::format("<{0}>{1}</{0}>", i == 0 ? "th" : "td", html_text(cell));
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

}  // namespace

void write_page(const std::filesystem::path& path, const std::string& title,
                const std::vector<PageSection>& sections) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>"
      "<style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n",
      html_text(title), style);
  for (const PageSection& s : sections) {
    if (!s.heading.empty()) html += fmt::format("<h2>{}</h2>\n", html_text(s.heading));
    if (!s.text.empty()) html += fmt::format("<p>{}</p>\n", html_text(s.text));
    if (!s.table.empty()) html += html_table(s.table);
    for (const auto& [file, caption] : s.pictures)
      html +=
          fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                      html_text(file), html_text(caption), html_text(caption));
  }
  write_file_atomically(path, html + "</body></html>\n");
}

}  // namespace microswarm::report
