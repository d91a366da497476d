// SPDX-License-Identifier: Apache-2.0
// Environments for learning.
#include <numbers>

#include "calls.hpp"
#include "environment_states.hpp"
#include "guarded.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/environments/environment_batch.hpp"
#include "microswarm/environments/gathering/gathering_episode.hpp"
#include "microswarm/environments/navigation/navigation_episode.hpp"
#include "microswarm/environments/navigation/navigation_picture.hpp"
#include "scenario_text.hpp"

namespace microswarm::python {
namespace {

template <class Rules>
Rules to_rules(const Given& settings) {
  Rules rules;
  warn(set_values(rules, to_settings(settings)));
  return rules;
}

/// A task and its environments, whose observations are arrays of `shape`.
template <class Task_, class Episode_, class Number_>
struct Environments {
  using Task = Task_;
  using Episode = Episode_;
  using Number = Number_;

  std::shared_ptr<const Task> task;
  std::vector<py::ssize_t> shape;  ///< of one observation
  environments::EnvironmentBatch<Episode, Number> batch;
  QuickCalls steps;

  Environments(Task given, std::vector<py::ssize_t> of_one, std::size_t count, int threads,
               environments::Autoreset autoreset)
      : task(std::make_shared<const Task>(std::move(given))),
        shape(std::move(of_one)),
        // same_step keeps the last observations beside the new ones
        batch(*task, count,
              size(autoreset == environments::Autoreset::same_step ? 2 * count : count), 0, threads,
              autoreset) {}
  /// Numbers of one observation. Throws InputError if all environments take more than 8 GB.
  std::size_t size(std::size_t count = 1) const {
    constexpr double most = 8e9;
    std::size_t numbers = 1;
    for (const py::ssize_t side : shape) numbers *= static_cast<std::size_t>(side);
    const std::size_t bytes = sizeof(Number) * numbers + task->episode_bytes();
    if (static_cast<double>(bytes) * static_cast<double>(count) > most)
      throw InputError("num_envs is " + std::to_string(count) + ", but one takes " +
                       std::to_string(bytes) + " bytes, and all must not take more than 8 GB");
    return numbers;
  }
};
using Gathering =
    Environments<environments::GatheringTask, environments::GatheringEpisode, std::uint8_t>;
struct Navigation
    : Environments<environments::NavigationTask, environments::NavigationEpisode, float> {
  using Environments::Environments;
  std::shared_ptr<const environments::NavigationPicture> picture;  ///< made when it is asked for
};

environments::Autoreset to_autoreset(const std::string& name) {
  if (name == "SameStep") return environments::Autoreset::same_step;
  if (name == "Disabled") return environments::Autoreset::disabled;
  return environments::Autoreset::next_step;
}

std::unique_ptr<Guarded<Gathering>> open_gathering(
    const py::array_t<std::uint8_t, py::array::c_style>& free,
    const std::optional<std::array<int, 2>>& goal, const Given& settings, std::size_t count,
    int threads, const std::string& autoreset) {
  if (free.ndim() != 2) throw InputError("a maze must have 2 dimensions");
  const auto rules = to_rules<environments::GatheringRules>(settings);
  std::optional<environments::MazePlace> place;
  if (goal) place = {.row = (*goal)[1], .column = (*goal)[0]};
  const auto height = static_cast<std::size_t>(free.shape(0));
  const auto width = static_cast<std::size_t>(free.shape(1));
  const std::span<const std::uint8_t> cells{free.data(), height * width};
  auto made = interruptible([&](const Stop&) {
    environments::GatheringTask task(environments::GatheringMaze(cells, width, height), rules,
                                     place);
    const std::vector<py::ssize_t> shape{task.maze.height(), task.maze.width(), task.channels()};
    return std::make_unique<Gathering>(std::move(task), shape, count, threads,
                                       to_autoreset(autoreset));
  });
  return std::make_unique<Guarded<Gathering>>(std::move(made), "environment");
}

std::unique_ptr<Guarded<Navigation>> open_navigation(const ScenarioText& scenario,
                                                     const Given& settings, std::size_t count,
                                                     int threads, const std::string& autoreset) {
  const auto rules = to_rules<environments::NavigationRules>(settings);
  auto made = interruptible([&](const Stop&) {
    environments::NavigationTask task(scenario.open(), rules);
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(task.observation_size())};
    return std::make_unique<Navigation>(std::move(task), shape, count, threads,
                                        to_autoreset(autoreset));
  });
  return std::make_unique<Guarded<Navigation>>(std::move(made), "environment");
}

std::size_t to_action(const Gathering&, std::uint8_t action) {
  if (action >= environments::GatheringMaze::moves.size())
    throw InputError("an action must be 0 to 7");
  return action;
}

/// Action from a heading [rad] and a share of the maximum speed; scaled from a velocity as a share
/// of the maximum in x and y, of which what is longer than 1 is cut.
environments::NavigationAction to_action(const Navigation& all, double first, double second) {
  if (all.task->rules().scaled) {
    constexpr double most = 1 + 1e-5;  // as float32 rounds
    if (!(std::abs(first) <= most && std::abs(second) <= most))
      throw InputError(
          "an action must be 2 numbers from -1 to 1, the velocity in x and y as shares of the "
          "maximum; with scaled=False it is a heading_rad and a share of the speed");
    const Vec2 velocity{first, second};
    return {heading_along(velocity), std::min(norm(velocity), 1.0) * all.task->max_speed()};
  }
  if (!std::isfinite(first) || !(second >= 0 && second <= 1))
    throw InputError("an action must be a finite heading_rad and a share of the speed from 0 to 1");
  return {first, second * all.task->max_speed()};
}

/// A copy of one observation.
template <class All>
py::array_t<typename All::Number> observation(All& all, std::size_t index) {
  py::array_t<typename All::Number> copy(all.shape);
  const std::size_t size = all.size();
  std::copy_n(all.batch.observations()->data() + index * size, size, copy.mutable_data());
  return copy;
}

/// Success and reason at the end of an episode, else empty.
py::dict info(const environments::EnvironmentStep& made) {
  py::dict out;
  if (!made.has_ended()) return out;
  out["success"] = py::bool_(made.success);
  out["is_success"] = py::bool_(made.success);  // the name that Stable-Baselines3 looks for
  out["reason"] = py::str(made.reason.data(), made.reason.size());
  return out;
}

/// Result of a step in Gymnasium's form; py::make_tuple would take half of a step's time.
template <class All>
py::tuple step_one(All& all, const environments::EnvironmentStep& made) {
  py::tuple out(5);
  PyObject* const parts[] = {observation(all, 0).release().ptr(), PyFloat_FromDouble(made.reward),
                             PyBool_FromLong(made.terminated), PyBool_FromLong(made.truncated),
                             info(made).release().ptr()};
  for (py::ssize_t i = 0; i < 5; ++i) PyTuple_SET_ITEM(out.ptr(), i, parts[i]);
  return out;
}

/// Index, success and reason of each episode that has ended with the last step; none if none has.
template <class All>
py::object ends(const All& all) {
  py::list list;
  for (std::size_t i = 0; i < all.batch.count(); ++i) {
    const environments::EnvironmentStep& made = all.batch.made(i);
    if (made.has_ended())
      list.append(py::make_tuple(i, made.success, py::str(made.reason.data(), made.reason.size())));
  }
  return list.empty() ? py::object(py::none()) : py::object(std::move(list));
}

/// Checks the array for a copy of all observations; null without one.
template <class All>
using Copy = std::optional<py::array_t<typename All::Number, py::array::c_style>>;

/// Steps all, environment i with `action(i)`.
template <class All, class Action>
py::tuple step_all(All& all, Copy<All>& copy, Action&& action) {
  std::span<typename All::Number> copied;
  if (copy) copied = {copy->mutable_data(), static_cast<std::size_t>(copy->size())};
  if (copy && copied.size() != all.batch.observations()->size())
    throw InputError("an array for the observations must have their shape");
  const auto count = static_cast<py::ssize_t>(all.batch.count());
  py::array_t<double> rewards(count);
  py::array_t<bool> terminated(count);
  py::array_t<bool> truncated(count);
  const auto bytes = [&](py::array_t<bool>& array) {
    return std::span(reinterpret_cast<std::uint8_t*>(array.mutable_data()), all.batch.count());
  };
  const std::span<double> to{rewards.mutable_data(), all.batch.count()};
  const auto ended = bytes(terminated);
  const auto cut = bytes(truncated);
  all.steps.call([&](const Stop& stop) {
    all.batch.step(action, to, ended, cut, copied, stop);
    return true;
  });
  return py::make_tuple(rewards, terminated, truncated, ends(all));
}

/// Calls `work(environments, index)` if that environment exists.
template <class All, class Work>
auto of_one(Work work) {
  return [work](Guarded<All>& open, std::size_t index) {
    return open.use([&](All& all) {
      if (index >= all.batch.count()) throw InputError("there is no such environment");
      return work(all, index);
    });
  };
}

/// Begins an episode in the environments of a mask.
template <class All>
void reset_some(All& all, const std::vector<std::optional<std::uint64_t>>& seeds,
                const std::vector<std::uint8_t>& mask) {
  if (seeds.size() != all.batch.count() || mask.size() != all.batch.count())
    throw InputError("there must be a seed and an entry of the mask for each environment");
  all.steps.call([&](const Stop& stop) {
    all.batch.reset(seeds, mask, stop);
    return true;
  });
}

/// Adds the methods that all kinds of environments have.
template <class All>
py::class_<Guarded<All>> add_kind(py::module_& module, const char* name) {
  return py::class_<Guarded<All>>(module, name)
      .def("close", &Guarded<All>::close)
      .def("reset",
           [](Guarded<All>& open, std::optional<std::uint64_t> seed) {
             open.use([&](All& all) {
               all.steps.call([&](const Stop& stop) {
                 all.batch.reset(seed, stop);
                 return true;
               });
             });
           })
      .def("reset_some",
           [](Guarded<All>& open, const std::vector<std::optional<std::uint64_t>>& seeds,
              const std::vector<std::uint8_t>& mask) {
             open.use([&](All& all) { reset_some(all, seeds, mask); });
           })
      .def("copy",
           [](Guarded<All>& open) {
             return open.use([](All& all) {
               auto made = interruptible([&](const Stop&) { return std::make_unique<All>(all); });
               return std::make_unique<Guarded<All>>(std::move(made), "environment");
             });
           })
      .def("states", [](Guarded<All>& open) { return open.use(states<All>); })
      .def("restore",
           [](Guarded<All>& open, const std::vector<py::tuple>& given) {
             open.use([&](All& all) { restore(all, given); });
           })
      // Last observation of an episode that ended with the last step.
      .def("final_observation", of_one<All>([](All& all, std::size_t index) {
             const auto last = all.batch.final_observation(index);
             py::array_t<typename All::Number> copy(all.shape);
             std::ranges::copy(last, copy.mutable_data());
             return copy;
           }))
      // A view of the observations, which each step updates.
      .def("observations",
           [](Guarded<All>& open) {
             return open.use([&](All& all) {
               std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(all.batch.count())};
               shape.insert(shape.end(), all.shape.begin(), all.shape.end());
               using Owner = std::shared_ptr<std::vector<typename All::Number>>;
               auto owner = std::make_unique<Owner>(all.batch.observations());
               const auto* const numbers = (*owner)->data();
               const py::capsule base(owner.release(),
                                      [](void* held) { delete static_cast<Owner*>(held); });
               return py::array_t<typename All::Number>(shape, numbers, base);
             });
           })
      .def("observation", of_one<All>(observation<All>));
}

/// Rows and columns of the particles.
py::array_t<int> particles(Gathering& all, std::size_t index) {
  const environments::GatheringMaze& maze = all.task->maze;
  const environments::ParticleMotion& motion = all.batch.episode(index).motion();
  std::vector<int> numbers;
  for (std::size_t i = 0; i < motion.cells().size(); ++i) {
    const environments::MazePlace place = maze.place(motion.cells()[i]);
    for (std::uint32_t k = 0; k < motion.counts()[i]; ++k)
      numbers.insert(numbers.end(), {place.row, place.column});
  }
  return py::array_t<int>({static_cast<py::ssize_t>(numbers.size() / 2), py::ssize_t{2}},
                          numbers.data());
}

py::array_t<std::int64_t> costs(Gathering& all, std::size_t index) {
  const environments::GatheringMaze& maze = all.task->maze;
  const environments::MazeCosts& costs = all.batch.episode(index).costs();
  py::array_t<std::int64_t> array({maze.height(), maze.width()});
  std::int64_t* out = array.mutable_data();
  for (int row = 0; row < maze.height(); ++row)
    for (int column = 0; column < maze.width(); ++column) {
      const std::uint32_t cost = costs.of[maze.number({row, column})];
      *out++ = cost == environments::MazeCosts::unreached ? -1 : std::int64_t{cost};
    }
  return array;
}

/// Colour picture of an environment, whose longer side has `side` pixels.
ByteArray picture(Navigation& all, std::size_t index) {
  constexpr std::size_t side = 480;
  if (!all.picture)
    all.picture = std::make_shared<environments::NavigationPicture>(*all.task, side);
  ByteArray image({static_cast<py::ssize_t>(all.picture->height()),
                   static_cast<py::ssize_t>(all.picture->width()), py::ssize_t{3}});
  all.picture->draw(all.batch.episode(index),
                    {image.mutable_data(), static_cast<std::size_t>(image.size())});
  return image;
}

void add_gathering(py::module_& module) {
  add_kind<Gathering>(module, "GatheringBatch")
      .def(py::init(&open_gathering))
      .def("step_one",
           [](Guarded<Gathering>& open, std::uint8_t action) {
             return open.use([&](Gathering& all) {
               return step_one(all, all.batch.episode(0).step(to_action(all, action)));
             });
           })
      .def("step",
           [](Guarded<Gathering>& open,
              const py::array_t<std::uint8_t, py::array::c_style>& actions, Copy<Gathering> copy) {
             return open.use([&](Gathering& all) {
               const std::span<const std::uint8_t> given{actions.data(),
                                                         static_cast<std::size_t>(actions.size())};
               if (given.size() != all.batch.count())
                 throw InputError("there must be an action for each environment");
               for (const std::uint8_t action : given) to_action(all, action);
               return step_all(all, copy, [&](std::size_t i) { return std::size_t{given[i]}; });
             });
           })
      .def("rules",
           [](Guarded<Gathering>& open) {
             return open.use([](Gathering& all) { return to_json_text(all.task->rules); });
           })
      .def("particles", of_one<Gathering>(particles))
      .def("costs", of_one<Gathering>(costs))
      .def("weights", of_one<Gathering>([](Gathering& all, std::size_t index) {
             const auto weights = all.batch.episode(index).motion().weights();
             return py::array_t<double>(static_cast<py::ssize_t>(weights.size()), weights.data());
           }))
      .def("goal", of_one<Gathering>([](Gathering& all, std::size_t index) {
             const environments::MazePlace place =
                 all.task->maze.place(all.batch.episode(index).goal());
             return py::make_tuple(place.column, place.row);
           }));
}

void add_navigation(py::module_& module) {
  add_kind<Navigation>(module, "NavigationBatch")
      .def(py::init(&open_navigation))
      .def("step_one",
           [](Guarded<Navigation>& open, double heading, double share) {
             return open.use([&](Navigation& all) {
               return step_one(all, all.batch.episode(0).step(to_action(all, heading, share)));
             });
           })
      .def("step",
           [](Guarded<Navigation>& open, const Numbers& actions, Copy<Navigation> copy) {
             return open.use([&](Navigation& all) {
               const std::size_t count = all.batch.count();
               if (actions.ndim() != 2 || actions.shape(1) != 2 ||
                   static_cast<std::size_t>(actions.shape(0)) != count)
                 throw InputError("there must be an action of 2 numbers for each environment");
               std::vector<environments::NavigationAction> given;
               given.reserve(count);
               const double* numbers = actions.data();
               for (std::size_t i = 0; i < count; ++i, numbers += 2)
                 given.push_back(to_action(all, numbers[0], numbers[1]));
               return step_all(all, copy, [&](std::size_t i) { return given[i]; });
             });
           })
      .def("rules",
           [](Guarded<Navigation>& open) {
             return open.use([](Navigation& all) { return to_json_text(all.task->rules()); });
           })
      .def("max_speed",
           [](Guarded<Navigation>& open) {
             return open.use([](Navigation& all) { return all.task->max_speed(); });
           })
      .def("picture", of_one<Navigation>(picture))
      .def("state", of_one<Navigation>([](Navigation& all, std::size_t index) {
             const environments::NavigationEpisode& episode = all.batch.episode(index);
             const Pose2& pose = episode.pose();
             return py::make_tuple(episode.time(), pose.position.x, pose.position.y, pose.heading,
                                   episode.goal().x, episode.goal().y,
                                   std::string(to_string(episode.status())));
           }));
}

}  // namespace

void add_environments(py::module_& module) {
  add_gathering(module);
  add_navigation(module);
}

}  // namespace microswarm::python
