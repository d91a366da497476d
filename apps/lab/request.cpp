// SPDX-License-Identifier: Apache-2.0
#include "lab/request.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::lab {
namespace {

using Json = nlohmann::json;

constexpr int max_depth = 2;  // an object with a list of texts

[[noreturn]] void refuse(std::string_view key, const char* wanted) {
  throw InputError(fmt::format("message: {} is not {}", quote(key), wanted));
}

Json parsed(std::string_view text) {
  if (text.size() > max_request_size)
    throw InputError(fmt::format("message: {} bytes, at most {}", text.size(), max_request_size));
  bool is_deep = false;
  const auto shallow = [&](int depth, Json::parse_event_t event, const Json&) {
    const bool begins =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    is_deep |= begins && depth >= max_depth;
    return !is_deep;
  };
  Json json = Json::parse(text, shallow, /*allow_exceptions=*/false);
  if (is_deep) throw InputError("message: nested too deeply");
  if (!json.is_object()) throw InputError("message: not a JSON object");
  return json;
}

double number_in(const std::string& key, const Json& value) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(key, "a number");
  return value.get<double>();
}

double scale_in(const std::string& key, const Json& value) {
  const double scale = number_in(key, value);
  if (!(scale >= 1e-6 && scale <= 1e6)) refuse(key, "a number in 1e-06..1e+06");
  return scale;
}

std::string text_in(const std::string& key, const Json& value) {
  if (!value.is_string()) refuse(key, "a text");
  return value.get<std::string>();
}

Ask ask_in(const std::string& key, const Json& value) {
  const std::string word = text_in(key, value);
  for (const auto& [ask, name] : enum_names(Ask{}))
    if (name == word) return ask;
  throw InputError(fmt::format("message: nothing is called {}", quote(word)));
}

std::vector<std::string> texts_in(const std::string& key, const Json& value) {
  if (!value.is_array() || value.size() > max_settings) refuse(key, "a list of texts");
  std::vector<std::string> texts;
  for (const Json& one : value) texts.push_back(text_in(key, one));
  return texts;
}

std::array<double, 2> place_in(const std::string& key, const Json& value) {
  if (!value.is_array() || value.size() != 2) refuse(key, "a place such as [1, 2]");
  return {number_in(key, value[0]), number_in(key, value[1])};
}

}  // namespace

Request read_request(std::string_view text) {
  Request request;
  bool asks = false;
  const Json json = parsed(text);
  for (const auto& [key, value] : json.items()) {
    if (key == "id") {
      if (!value.is_number_unsigned()) refuse(key, "a whole number");
      request.id = value.get<std::uint64_t>();
    } else if (key == "do") {
      request.ask = ask_in(key, value);
      asks = true;
    } else if (key == "number") {
      request.number = number_in(key, value);
    } else if (key == "heading") {
      request.heading = number_in(key, value);
    } else if (key == "speed") {
      request.speed = number_in(key, value);
    } else if (key == "on") {
      if (!value.is_boolean()) refuse(key, "true or false");
      request.on = value.get<bool>();
    } else if (key == "key") {
      request.key = text_in(key, value);
    } else if (key == "value") {
      request.value = text_in(key, value);
    } else if (key == "settings") {
      request.settings = texts_in(key, value);
    } else {
      throw InputError(fmt::format("message: no key {}", quote(key)));
    }
  }
  if (!asks) throw InputError("message: \"do\" is missing");
  return request;
}

std::uint64_t id_in(std::string_view text) {
  try {
    const Json json = parsed(text);
    const auto id = json.find("id");
    return id != json.end() && id->is_number_unsigned() ? id->get<std::uint64_t>() : 0;
  } catch (const InputError&) {
    return 0;
  }
}

OpenRequest read_open_request(std::string_view text) {
  OpenRequest request;
  const Json json = parsed(text);
  for (const auto& [key, value] : json.items()) {
    if (key == "file")
      request.file = text_in(key, value);
    else if (key == "settings")
      request.settings = texts_in(key, value);
    else if (key == "photo")
      request.photo = text_in(key, value);
    else if (key == "um_per_px")
      request.um_per_px = scale_in(key, value);
    else
      throw InputError(fmt::format("message: no key {}", quote(key)));
  }
  if (request.photo.has_value() != (request.um_per_px > 0))
    throw InputError("message: photo and um_per_px go together");
  return request;
}

PhotoRequest read_photo_request(std::string_view text) {
  PhotoRequest request;
  const Json json = parsed(text);
  for (const auto& [key, value] : json.items()) {
    if (key == "file") {
      request.file = text_in(key, value);
    } else if (key == "settings") {
      request.settings = texts_in(key, value);
    } else if (key == "um_per_px") {
      request.um_per_px = scale_in(key, value);
    } else if (key == "start") {
      request.start = place_in(key, value);
    } else if (key == "goal") {
      request.goal = place_in(key, value);
    } else if (key == "robots") {
      const double robots = number_in(key, value);
      if (!(robots >= 1 && robots <= 10'000)) refuse(key, "a number in 1..10000");
      request.robots = static_cast<int>(robots);
    } else {
      throw InputError(fmt::format("message: no key {}", quote(key)));
    }
  }
  return request;
}

}  // namespace microswarm::lab
