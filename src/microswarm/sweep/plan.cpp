// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/input_folder.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/scenario/validate.hpp"

namespace microswarm::sweep {
namespace {

/// Calls body(i) for all i, until stopped, on several threads and rethrows the exception of the
/// lowest i.
template <class Body>
void for_each_in_order(std::size_t count, int jobs, const Stop& stop, Body body) {
  std::vector<std::exception_ptr> thrown(count);
  for_each_index(count, jobs, [&](std::size_t i) {
    if (stop()) return;
    try {
      body(i);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& one : thrown)
    if (one) std::rethrow_exception(one);
}

/// Maps by fingerprint, each built once.
class MapCache {
 public:
  World find_world(const experiment::Scene& scene) {
    const std::uint64_t key = formats::fingerprint(scene.map);
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = maps_.find(key); found != maps_.end())
        return {found->second, scene.scenario.obstacles};
    }
    World world = experiment::build_world(scene);
    const std::lock_guard lock(mutex_);
    world.map = maps_.emplace(key, world.map).first->second;
    return world;
  }

 private:
  std::mutex mutex_;
  std::map<std::uint64_t, std::shared_ptr<const Map>> maps_;
};

std::string cell_name(const SweepPlan& plan, const SweepCell& cell) {
  std::string name;
  for (std::size_t i = 0; i < cell.values.size(); ++i)
    name += fmt::format("{}={}, ", plan.sweep.grid[i].key, cell.values[i]);
  return fmt::format("{}: {}method '{}'", plan.file, name, cell.method);
}

/// Locations that prefix issues with the cell's name and know only whether a key is given.
KeyLocations find_locations(const SweepPlan& plan, const SweepCell& cell) {
  using Seek = KeyLocations::Seek;
  const std::string name = cell_name(plan, cell);
  const KeyLocations written = find_locations(plan.scenario_document, name, {cell.settings, ""});
  return {name, [written](std::string_view key, Seek seek) -> std::optional<std::string> {
            if (seek != Seek::itself || !written.given(key)) return std::nullopt;
            return "";
          }};
}

struct Loader {
  const SweepPlan& plan;
  const experiment::Scenario& base;
  std::filesystem::path folder;
  MapCache& maps;

  /// Applies a setting and stores it with its current keys; locations of issues begin with `what`.
  /// False for a key that no longer exists, which becomes a note.
  bool apply(SweepCell& cell, const Setting& setting, const std::string& what) const {
    Notes notes;
    auto present = set_value(cell.scenario, setting, what, notes);
    for (const std::string& note : notes)
      cell.notes.push_back(fmt::format("{}: {}", plan.file, note));
    if (present) cell.settings.push_back(std::move(*present));
    return present.has_value();
  }

  /// The base with the cell's settings.
  void set_up(SweepCell& cell, const SweepMethod& method) const {
    cell.scenario = base;
    const std::string of_method = fmt::format("method '{}':", method.name);
    std::vector<Setting> all;
    std::vector<std::string> origins;
    const auto add = [&](const Settings& from) {
      all.insert(all.end(), from.list.begin(), from.list.end());
      origins.resize(all.size(), from.option);
    };
    add(Settings(plan.sweep.set, "set:"));
    add(Settings(method.set, fmt::format("method '{}':", method.name)));
    const std::size_t fixed = all.size();
    for (std::size_t i = 0; i < cell.values.size(); ++i)
      add(Settings({Setting{plan.sweep.grid[i].key, cell.values[i]}}, "grid:"));
    std::vector<std::string> varied;
    for (const std::size_t i : types_first(all))
      if (apply(cell, all[i], origins[i]) && i >= fixed) varied.push_back(cell.settings.back().key);
    for (const std::string& key : varied)
      if (std::ranges::count(cell.settings, key, &Setting::key) > 1)
        throw InputError(Issue{
            .keys = {key},
            .text = fmt::format("{} is varied by the grid and set a second time, in the grid, "
                                "in 'set' or by method '{}'",
                                quote(key), method.name)});
    if (plan.sweep.seed) cell.scenario.seed = *plan.sweep.seed;
  }

  const SweepMethod& method_at(std::size_t index) const {
    return plan.sweep.methods[index % plan.sweep.methods.size()];
  }

  SweepCell cell_at(std::size_t index) const {
    SweepCell cell;
    const SweepMethod& method = method_at(index);
    index /= plan.sweep.methods.size();
    cell.method = method.name;
    cell.values.resize(plan.sweep.grid.size());
    for (std::size_t i = cell.values.size(); i-- > 0;) {
      const std::vector<std::string>& values = plan.sweep.grid[i].values;
      cell.values[i] = values[index % values.size()];
      index /= values.size();
    }
    try {
      set_up(cell, method);
    } catch (const InputError& error) {
      throw InputError(error.issues().placed_in(plan.file));
    }
    const experiment::Scene scene =
        experiment::load_scene(cell.scenario, folder, cell_name(plan, cell));
    cell.notes.insert(cell.notes.end(), scene.map.notes.begin(), scene.map.notes.end());
    cell.input_hash = scene.hash();
    cell.world = maps.find_world(scene);
    cell.scenario = scene.scenario;
    return cell;
  }
};

}  // namespace

std::string SweepPlan::hash() const {
  Hash hash;
  hash.text(to_yaml(sweep));
  hash.text(scenario_text);
  for (const SweepCell& cell : cells) hash.text(cell.input_hash);
  return hash.hex();
}

SweepPlan plan_sweep(Sweep sweep, const std::string& name, const SweepBase& base, int jobs,
                     const Stop& stop) {
  SweepPlan plan{.sweep = std::move(sweep), .file = name};
  const auto scenario = read_yaml_text<experiment::Scenario>(base.text, base.name);
  plan.scenario_document = parse_yaml(base.text, base.name);
  use_present_keys(type_of<experiment::Scenario>(), plan.scenario_document, base.name,
                   experiment::Scenario::moved_keys, plan.notes);
  plan.scenario_text = scenario_text(scenario);
  MapCache maps;
  const Loader loader{plan, scenario, base.folder, maps};
  std::vector<SweepCell> cells(cell_count(plan.sweep));
  cells[0] = loader.cell_at(0);  // first, for the map that all may share
  for_each_in_order(cells.size() - 1, jobs, stop,
                    [&](std::size_t i) { cells[i + 1] = loader.cell_at(i + 1); });
  if (stop()) return plan;
  plan.cells = std::move(cells);
  for (const SweepCell& cell : plan.cells)
    for (const std::string& note : cell.notes)
      if (std::ranges::find(plan.notes, note) == plan.notes.end()) plan.notes.push_back(note);
  return plan;
}

SweepPlan load_sweep(const std::filesystem::path& file, int jobs, const Stop& stop) {
  Sweep sweep = read_sweep(file);
  const std::filesystem::path scenario = input_folder(file) / sweep.scenario;
  const SweepBase base{read_file(scenario, max_yaml_bytes), scenario.string(),
                       scenario.parent_path()};
  return plan_sweep(std::move(sweep), file.string(), base, jobs, stop);
}

void check(const SweepPlan& plan, int jobs, const Stop& stop) {
  for_each_in_order(plan.cells.size(), jobs, stop, [&](std::size_t i) {
    const SweepCell& cell = plan.cells[i];
    const KeyLocations keys = find_locations(plan, cell);
    keys.require_none(validate(cell.scenario, cell.world, keys.is_given()));
  });
}

}  // namespace microswarm::sweep
