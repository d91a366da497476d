// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/figures.hpp"

#include <fmt/ranges.h>

#include <cstdlib>
#include <filesystem>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/choices.hpp"
#include "microswarm/core/text/file.hpp"

namespace microswarm::reproduce {
namespace {

std::vector<report::ReproduceRow> interrupted(std::string_view figure,
                                              std::vector<report::ReproduceRow> rows) {
  if (rows.empty()) rows.push_back({.figure = std::string(figure), .quantity = "interrupted"});
  for (report::ReproduceRow& row : rows) row = unjudged(std::move(row), "interrupted");
  return rows;
}

}  // namespace

std::vector<report::ReproduceRow> reproduce_figures(std::string_view paper,
                                                    std::span<const Figure> figures,
                                                    const std::string& figure,
                                                    const ReproduceOptions& options,
                                                    const Stop& stop) {
  std::vector<report::ReproduceRow> rows;
  std::vector<std::string_view> names;
  bool known = figure.empty();
  for (const auto& [name, make] : figures) {
    names.push_back(name);
    if (!figure.empty() && figure != name) continue;
    known = true;
    if (stop()) continue;
    auto more = make(options, stop);
    if (stop()) more = interrupted(name, std::move(more));
    for (report::ReproduceRow& row : more)
      if (!row.aim && !row.paper && row.note.empty()) row.note = "not in the paper";
    rows.insert(rows.end(), more.begin(), more.end());
  }
  if (!known)
    throw InputError(fmt::format("reproduce {}: unknown figure '{}', {}", paper, figure,
                                 allowed_words(figure, names)));
  if (!options.out.empty())
    write_file_atomically(std::filesystem::path(options.out) / fmt::format("{}.csv", paper),
                          report::rows_csv(rows));
  return rows;
}

std::optional<std::filesystem::path> data_file(const ReproduceOptions& options,
                                               std::string_view name, std::string_view what) {
  const char* data = std::getenv("MICROSWARM_DATA");
  const auto file = (std::filesystem::path(data ? data : "") / name).lexically_normal();
  if (data && std::filesystem::exists(file)) return file;
  if (options.note)
    options.note(data ? fmt::format("{}: left out, {} is absent", what, file.string())
                      : fmt::format("{}: left out, MICROSWARM_DATA is not set", what));
  return std::nullopt;
}

}  // namespace microswarm::reproduce
