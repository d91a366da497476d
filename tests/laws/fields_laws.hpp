// SPDX-License-Identifier: Apache-2.0
// Laws of everything that lists its fields.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/text/text.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::laws {

/// A value that is no struct of its own, under one key.
template <class T>
struct Keyed {
  T value{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.value, plain("value", "The value.").needed());
  }
};

/// What is written reads back to the same bits.
template <class T>
void expect_reads_back(const T& value) {
  const std::string text = to_yaml(Keyed<T>{value});
  const auto again = read_yaml_text<Keyed<T>>(text, "law.yaml");
  EXPECT_EQ(to_yaml(again), text);
}

/// Sets a number of `value` to `bad`, by its key, and expects one line that says so.
template <class T>
void expect_refused(const T& value, const std::string& key, const std::string& bad,
                    const std::string& limit) {
  Keyed<T> changed{value};
  const std::string what = test::error_of([&] { set_value(changed, key + "=" + bad, "--set"); });
  EXPECT_TRUE(test::is_one_line_naming(what, "--set " + key, {bad})) << limit;
  EXPECT_TRUE(test::names(what, limit)) << what << " does not name " << limit;
  EXPECT_EQ(to_yaml(changed), to_yaml(Keyed<T>{value})) << key << " is kept";
}

template <class T>
int expect_limits_of(const T& value, const Type& type, const void* at, const FieldInfo& info,
                     const std::string& key) {
  int checked = 0;
  switch (type.kind) {
    case TypeKind::record:
      for (const Field& field : type.fields)
        checked += expect_limits_of(value, *field.type, field.in(at), field.info,
                                    key.empty() ? field.key : key + "." + field.key);
      return checked;
    case TypeKind::variant:
    case TypeKind::optional:
      if (type.kind == TypeKind::variant || type.count(at) > 0) {
        const std::size_t held = type.kind == TypeKind::variant ? type.count(at) : 0;
        return expect_limits_of(value, *type.parts[held], type.find_part(at), info, key);
      }
      return 0;
    case TypeKind::list:
      return type.count(at) == 0
                 ? 0
                 : expect_limits_of(value, *type.parts[0], type.find_part(at, 0), info, key + ".0");
    case TypeKind::point:
    case TypeKind::number:
    case TypeKind::integer:
      break;
    default:
      return 0;
  }
  const bool is_point = type.kind == TypeKind::point;
  const auto refuse = [&](double bad, double limit) {
    const std::string text = number_text(bad);
    if (!is_point) return expect_refused(value, key, text, number_text(limit));
    Keyed<T> changed{value};
    const std::string what =
        test::error_of([&] { set_value(changed, key + "=[0, " + text + "]", "--set"); });
    EXPECT_TRUE(test::names(what, text)) << what;
    EXPECT_TRUE(test::names(what, number_text(limit))) << what;
  };
  if (std::isfinite(info.range.max))
    ++checked, refuse(info.range.max + std::ceil(std::abs(info.range.max)) + 1, info.range.max);
  if (std::isfinite(info.range.min))
    ++checked, refuse(info.range.min - std::ceil(std::abs(info.range.min)) - 1, info.range.min);
  return checked;
}

/// Every number beyond its limit is refused in one line that names key, value and limit, and
/// nothing is changed. How many limits there are.
template <class T>
int expect_limits_are_kept(const T& value) {
  const Keyed<T> keyed{value};
  return expect_limits_of(value, type_of<Keyed<T>>(), &keyed, {}, "");
}

}  // namespace microswarm::laws
