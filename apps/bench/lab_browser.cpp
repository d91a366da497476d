// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/lab.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::bench {
namespace {

namespace fs = std::filesystem;

/// Output of a program; empty if it fails.
std::string run_command(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (!pipe) return {};
  char part[4096];
  while (const std::size_t size = std::fread(part, 1, sizeof part, pipe)) text.append(part, size);
  return ::pclose(pipe) == 0 ? text : std::string();
}

}  // namespace

std::vector<report::BenchRow> lab_in_browser(const fs::path& checkout, bool quick) {
  const fs::path script = checkout / "web/bench.mjs";
  const fs::path bin = fs::read_symlink("/proc/self/exe").parent_path();
  const std::string text =
      fs::exists(script)
          ? run_command(fmt::format("MICROSWARM='{}' node '{}' {}", (bin / "microswarm").string(),
                                    script.string(), quick ? "--quick" : ""))
          : std::string();
  if (text.empty()) {
    std::fputs("note: no rows of a browser: Node.js, Chromium or web/node_modules are missing\n",
               stderr);
    return {};
  }
  std::vector<report::BenchRow> rows;
  for (const auto& one : nlohmann::json::parse(text)) {
    report::BenchRow row{.name = one["name"], .quantity = one["quantity"], .unit = one["unit"]};
    row.ours = one["ours"];
    if (one.contains("aim")) row.aim = one["aim"].get<double>();
    row.at_most = one.value("at_most", true);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace microswarm::bench
