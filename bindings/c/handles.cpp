// SPDX-License-Identifier: Apache-2.0
#include "handles.hpp"

#include <mutex>
#include <new>
#include <shared_mutex>
#include <unordered_map>

#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/version.hpp"

namespace microswarm::c {
namespace {

/// All open objects. Handles are never reused.
struct Registry {
  std::shared_mutex mutex;
  std::unordered_map<std::uint64_t, std::shared_ptr<Object>> objects;
  std::uint64_t next = 1;
};

std::once_flag names_inputs;

/// The setting by which a caller gives an input that is no parameter of a function.
std::string key_of_input(std::string_view input) {
  if (input == "read_record") return "ms_session_open";
  return input == "um_per_unit" ? "map.um_per_unit" : "";
}

/// Never destroyed, since a caller may close its handles while the program ends.
Registry& registry() {
  static auto* const all = new Registry;  // NOLINT(cppcoreguidelines-owning-memory)
  return *all;
}

/// Why the last call of the thread that failed did.
struct Failure {
  Issues issues;
  std::string text;
};

Failure& failure() {
  thread_local Failure last;
  return last;
}

}  // namespace

std::uint64_t keep(std::unique_ptr<Object> object) {
  Registry& all = registry();
  const std::unique_lock lock(all.mutex);
  all.objects.emplace(all.next, std::move(object));
  return all.next++;
}

std::shared_ptr<Object> find(std::uint64_t handle) {
  Registry& all = registry();
  const std::shared_lock lock(all.mutex);
  const auto found = all.objects.find(handle);
  return found == all.objects.end() ? nullptr : found->second;
}

bool forget(std::uint64_t handle) {
  Registry& all = registry();
  std::shared_ptr<Object> closed;  // destroyed after the lock is released
  const std::unique_lock lock(all.mutex);
  const auto found = all.objects.find(handle);
  if (found == all.objects.end()) return false;
  closed = std::move(found->second);
  all.objects.erase(found);
  return true;
}

std::int32_t fail(ms_code code, const Issues& issues) noexcept {
  try {
    failure() = {issues, to_string(issues)};
  } catch (...) {
    failure() = {};
  }
  return code;
}

std::int32_t fail(ms_code code, const std::string& text) noexcept {
  try {
    Issues issues;
    issues.add(Issue{.text = text});
    return fail(code, issues);
  } catch (...) {
    return fail(code, Issues());
  }
}

std::int32_t guarded(const std::function<std::int32_t()>& work) noexcept {
  try {
    std::call_once(names_inputs, [] { name_inputs(key_of_input); });
    return work();
  } catch (const BadCall& bad) {
    return fail(MS_BAD_CALL, bad.text);
  } catch (const InputError& error) {
    return fail(MS_BAD_INPUT, error.issues());
  } catch (const std::bad_alloc&) {
    return fail(MS_NO_MEMORY, "there is not enough memory");
  } catch (const std::exception& error) {
    return fail(MS_FAULT, error.what());
  } catch (...) {
    return fail(MS_FAULT, "an unknown error");
  }
}

Settings to_settings(const char* const* texts, std::size_t count) {
  std::vector<std::string> all;
  if (count > 0) require(texts, "settings");
  constexpr std::size_t most = 100'000;
  if (count > most) throw BadCall{"there are more than 100000 settings"};
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    require(texts[i], "a setting");
    all.emplace_back(texts[i]);
  }
  return {all, ""};
}

std::int32_t show(Object& object, std::span<const Vec2> positions, const double** xy,
                  std::size_t* count) {
  require(xy, "xy_um"), require(count, "count");
  object.numbers.clear();
  object.numbers.reserve(2 * positions.size());
  for (const Vec2& position : positions)
    object.numbers.insert(object.numbers.end(), {position.x, position.y});
  *xy = positions.empty() ? nullptr : object.numbers.data();
  *count = positions.size();
  return MS_OK;
}

}  // namespace microswarm::c

using namespace microswarm;

const char* ms_version(void) { return version.data(); }
int32_t ms_interface(void) { return MS_INTERFACE; }
const char* ms_error_text(void) { return c::failure().text.c_str(); }
size_t ms_issue_count(void) { return c::failure().issues.size(); }

int32_t ms_issue_at(size_t i, ms_issue* issue) {
  if (!issue || i >= ms_issue_count()) return MS_BAD_CALL;
  const Issue& one = c::failure().issues[i];
  *issue = {one.keys.empty() ? "" : one.keys.front().c_str(), one.location.c_str(),
            one.text.c_str(), one.value.c_str(), one.limit.c_str()};
  return MS_OK;
}

int32_t ms_close(uint64_t handle) {
  return c::guarded([&]() -> int32_t {
    if (!c::forget(handle)) throw c::BadCall{"the handle is closed already, or never was one"};
    return MS_OK;
  });
}

int32_t ms_stop(uint64_t handle) {
  return c::guarded([&]() -> int32_t {
    const auto object = c::find(handle);
    if (!object) throw c::BadCall{"the handle is closed, or never was one"};
    object->stops = true;
    return MS_OK;
  });
}

const char* ms_state_name(int32_t state) {
  for (const auto& [value, name] : enum_names(NavigatorState{}))
    if (static_cast<int32_t>(value) == state) return name.data();
  return "";
}
