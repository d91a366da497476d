// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/message.hpp"

#include <fmt/format.h>

#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"

namespace microswarm::sweep {
namespace {

using Json = nlohmann::json;

// A number is stored as its bits in an array of one, since CBOR would make all NaNs equal.
Json to_json(const SqlValue& value) {
  return std::visit(
      Overloaded{[](std::monostate) { return Json(nullptr); },
                 [](const OneOf<std::int64_t, std::string> auto& held) { return Json(held); },
                 [](double real) { return Json::array({std::bit_cast<std::uint64_t>(real)}); }},
      value);
}

// The functions below throw std::exception for other types or ranges.

std::uint64_t to_whole(const Json& json, std::uint64_t max = ~std::uint64_t{0}) {
  const auto whole = json.get_ref<const std::uint64_t&>();
  if (whole > max) throw std::out_of_range("number in a message");
  return whole;
}

std::uint32_t to_word(const Json& json) {
  return static_cast<std::uint32_t>(to_whole(json, std::numeric_limits<std::uint32_t>::max()));
}

SqlValue value_of_json(const Json& json) {
  if (json.is_null()) return std::monostate{};
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_array()) return std::bit_cast<double>(to_whole(json.at(0)));
  return json.get_ref<const std::string&>();
}

const Json::array_t& to_list(const Json& json) { return json.get_ref<const Json::array_t&>(); }

}  // namespace

std::string to_bytes(const SweepMessage& message) {
  Json tasks = Json::array();
  for (const SweepTask& task : message.tasks) tasks.push_back({task.cell, task.trial});
  Json rows = Json::array();
  for (const SweepRow& row : message.rows) {
    Json values = Json::array();
    for (const SqlValue& value : row.values) values.push_back(to_json(value));
    rows.push_back({row.task.cell, row.task.trial, std::move(values)});
  }
  const Json all = {static_cast<std::uint8_t>(message.kind), message.text, message.want,
                    std::move(tasks), std::move(rows)};
  std::string bytes;
  Json::to_cbor(all, bytes);
  return bytes;
}

SweepMessage parse_message(std::string_view bytes) try {
  const Json all = Json::from_cbor(bytes);
  SweepMessage message;
  constexpr auto last = static_cast<std::uint64_t>(SweepMessage::Kind::over);
  message.kind = static_cast<SweepMessage::Kind>(to_whole(all.at(0), last));
  message.text = all.at(1).get_ref<const std::string&>();
  message.want = to_word(all.at(2));
  for (const Json& task : to_list(all.at(3)))
    message.tasks.push_back({to_word(task.at(0)), to_word(task.at(1))});
  for (const Json& row : to_list(all.at(4))) {
    message.rows.push_back({{to_word(row.at(0)), to_word(row.at(1))}, {}});
    for (const Json& value : to_list(row.at(2)))
      message.rows.back().values.push_back(value_of_json(value));
  }
  return message;
} catch (const std::exception&) {
  throw InputError(fmt::format("mpirun: malformed message of {} bytes", bytes.size()));
}

}  // namespace microswarm::sweep
