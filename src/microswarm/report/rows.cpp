// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace microswarm::report {
namespace {

using Cells = std::vector<std::string>;
using Json = nlohmann::ordered_json;

std::string number(double v) {
  return std::abs(v) >= 1e6 ? fmt::format("{:.3e}", v) : fmt::format("{:.4g}", v);
}
std::string number(const std::optional<double>& v) { return v ? number(*v) : "–"; }

std::string aim_text(const std::optional<double>& aim, bool at_most) {
  return aim ? (at_most ? "≤ " : "≥ ") + number(*aim) : "–";
}

template <class Row>
std::string verdict(const Row& row) {
  if (!row.has_verdict()) return row.aim ? "no verdict" : "";
  return row.ok() ? "ok" : "falls short";
}

Json json(const std::optional<double>& v) { return v ? Json(*v) : Json(nullptr); }

std::size_t to_columns(const std::string& s) {
  return static_cast<std::size_t>(
      std::count_if(s.begin(), s.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string text_table(const std::vector<Cells>& lines) {
  std::vector<std::size_t> width;
  for (const Cells& line : lines) {
    width.resize(std::max(width.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i)
      width[i] = std::max(width[i], to_columns(line[i]));
  }
  std::string out;
  for (const Cells& line : lines) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i)
      text += line[i] + std::string(width[i] - to_columns(line[i]) + 2, ' ');
    out += text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string csv_cell(const std::string& s) {
  if (s.find_first_of(",\"\n") == std::string::npos) return s;
  std::string out = "\"";
  for (char c : s) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string csv(const std::vector<Cells>& lines) {
  std::string out;
  for (const Cells& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i)
      out += csv_cell(line[i]) + (i + 1 < line.size() ? "," : "\n");
  return out;
}

std::string csv_number(const std::optional<double>& v) {
  return v ? fmt::format("{:.6g}", *v) : "";
}

}  // namespace

std::optional<double> BenchRow::ratio() const {
  if (!peer || ours == 0 || *peer == 0) return std::nullopt;
  return at_most ? *peer / ours : ours / *peer;
}

std::string rows_json(const std::vector<ReproduceRow>& rows) {
  Json list = Json::array();
  for (const auto& r : rows) {
    Json row = {{"figure", r.figure},
                {"quantity", r.quantity},
                {"unit", r.unit},
                {"paper", json(r.paper)},
                {"ours", json(r.ours)},
                {"aim", json(r.aim)},
                {"ok", r.has_verdict() ? Json(r.ok()) : Json(nullptr)}};
    if (!r.note.empty()) row["note"] = r.note;
    list.push_back(std::move(row));
  }
  return Json{{"rows", list}}.dump(2) + "\n";
}

std::string rows_json(const std::vector<BenchRow>& rows) {
  Json list = Json::array();
  for (const auto& r : rows)
    list.push_back({{"name", r.name},
                    {"quantity", r.quantity},
                    {"unit", r.unit},
                    {"ours", r.ours},
                    {"peer", json(r.peer)},
                    {"peer_name", r.peer_name},
                    {"ratio", json(r.ratio())},
                    {"aim", json(r.aim)},
                    {"ok", r.has_verdict() ? Json(r.ok()) : Json(nullptr)}});
  return Json{{"rows", list}}.dump(2) + "\n";
}

std::string rows_table(const std::vector<ReproduceRow>& rows) {
  std::vector<Cells> lines{{"figure", "quantity", "unit", "paper", "ours", "aim", "", ""}};
  for (const auto& r : rows)
    lines.push_back({r.figure, r.quantity, r.unit, number(r.paper), number(r.ours),
                     aim_text(r.aim, r.at_most), verdict(r), r.note});
  return text_table(lines);
}

std::string rows_table(const std::vector<BenchRow>& rows) {
  std::vector<Cells> lines{{"name", "quantity", "unit", "ours", "peer", "", "ratio", "aim", ""}};
  for (const auto& r : rows)
    lines.push_back({r.name, r.quantity, r.unit, number(r.ours), number(r.peer), r.peer_name,
                     number(r.ratio()), aim_text(r.aim, r.at_most), verdict(r)});
  return text_table(lines);
}

std::string rows_csv(const std::vector<ReproduceRow>& rows) {
  std::vector<Cells> lines{{"figure", "quantity", "unit", "paper", "ours", "aim", "ok", "note"}};
  for (const auto& r : rows)
    lines.push_back({r.figure, r.quantity, r.unit, csv_number(r.paper), csv_number(r.ours),
                     csv_number(r.aim), r.has_verdict() ? (r.ok() ? "true" : "false") : "",
                     r.note});
  return csv(lines);
}

std::string rows_csv(const std::vector<BenchRow>& rows) {
  std::vector<Cells> lines{
      {"name", "quantity", "unit", "ours", "peer", "peer_name", "ratio", "aim", "ok"}};
  for (const auto& r : rows)
    lines.push_back({r.name, r.quantity, r.unit, csv_number(r.ours), csv_number(r.peer),
                     r.peer_name, csv_number(r.ratio()), csv_number(r.aim),
                     r.has_verdict() ? (r.ok() ? "true" : "false") : ""});
  return csv(lines);
}

}  // namespace microswarm::report
