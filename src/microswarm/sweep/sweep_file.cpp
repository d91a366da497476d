// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/sweep_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "microswarm/config/file_kind.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::sweep {
namespace {

/// The first duplicate text, or nothing.
std::optional<std::string> twin(std::vector<std::string> texts) {
  std::sort(texts.begin(), texts.end());
  const auto found = std::adjacent_find(texts.begin(), texts.end());
  if (found == texts.end()) return std::nullopt;
  return *found;
}

bool is_seed(std::string_view key) { return key == "seed" || key.starts_with("seed="); }

enum class Seeds { by_trials, settable };

class Checker {
 public:
  Checker(const std::string& name, Seeds seeds) : name_(name), seeds_(seeds) {}

  template <class... Values>
  void need(bool good, fmt::format_string<Values...> format, Values&&... values) const {
    if (!good) throw InputError(name_, fmt::format(format, std::forward<Values>(values)...));
  }

  void parameter(const SweepParameter& parameter) const {
    need(!parameter.key.empty(), "a parameter of the grid has an empty key");
    need(!parameter.values.empty(), "values of {} is empty", quote(parameter.key));
    need(may_set(parameter.key), "the grid sets 'seed': trials differ by themselves");
    const auto twice = twin(parameter.values);
    need(!twice, "values of {} has {} twice", quote(parameter.key), quote(twice.value_or("")));
  }

  void settings(const std::vector<std::string>& settings) const {
    for (const std::string& setting : settings)
      need(may_set(setting), "{} stands in 'set': give the sweep's key 'seed'", quote(setting));
  }

  void method(const SweepMethod& method) const {
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    need(!method.name.empty() && std::none_of(method.name.begin(), method.name.end(), control),
         "a method's name is {}, must be one line of text", quote(method.name));
    settings(method.set);
  }

  void sweep(const Sweep& sweep) const {
    std::vector<std::string> keys, names;
    for (const SweepParameter& one : sweep.grid) parameter(one), keys.push_back(one.key);
    for (const SweepMethod& one : sweep.methods) method(one), names.push_back(one.name);
    settings(sweep.set);
    if (const auto twice = twin(keys)) need(false, "the grid has {} twice", quote(*twice));
    if (const auto twice = twin(names)) need(false, "two methods are called {}", quote(*twice));
    const std::size_t cells = cell_count(sweep);
    need(cells <= max_cells, "more than {} cells", max_cells);
    need(cells * static_cast<std::size_t>(sweep.trials) <= max_trials, "more than {} trials in all",
         max_trials);
  }

 private:
  bool may_set(std::string_view key) const { return seeds_ == Seeds::settable || !is_seed(key); }

  const std::string& name_;
  Seeds seeds_;
};

Sweep checked(Sweep sweep, const std::string& name, Seeds seeds) {
  Checker(name, seeds).sweep(sweep);
  if (sweep.methods.empty()) sweep.methods.push_back({"default", {}});
  return sweep;
}

}  // namespace

std::size_t cell_count(const Sweep& sweep) {
  std::size_t cells = std::max<std::size_t>(1, sweep.methods.size());
  for (const SweepParameter& parameter : sweep.grid)
    cells = std::min(cells * parameter.values.size(), max_cells + 1);
  return cells;
}

Sweep read_sweep_text(std::string_view text, const std::string& name) {
  try {
    return checked(read_yaml_text<Sweep>(text, name), name, Seeds::by_trials);
  } catch (const InputError&) {
    refuse_other_kind(text, name, "sweep");
    throw;
  }
}

Sweep checked_sweep(Sweep sweep, const std::string& name) {
  return checked(std::move(sweep), name, Seeds::settable);
}

Sweep read_sweep(const std::filesystem::path& file) {
  return read_sweep_text(read_file(file, max_yaml_bytes), file.string());
}

}  // namespace microswarm::sweep
