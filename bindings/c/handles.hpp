// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "microswarm.h"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/queries/path_query.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/experiment/session/standalone_navigator.hpp"

namespace microswarm::c {

/// A map that paths are planned in.
struct OpenMap {
  Snapshot world;
  std::string name;
  std::string notes_of_reading{};  ///< a line each
  std::string notes{};             ///< with those of the last plan
};

/// Object behind a handle: one of the first three members. It owns the text and numbers that were
/// returned to the caller until the next call.
struct Object {
  std::unique_ptr<experiment::Session> session;
  std::unique_ptr<experiment::StandaloneNavigator> navigator;
  std::unique_ptr<OpenMap> map;

  std::mutex in_use;
  std::atomic<bool> stops = false;
  std::string text;
  std::vector<double> numbers;
  std::vector<ms_frame> frames;
  std::optional<experiment::Frame> frame;  ///< the session's newest; none before its first tick
  std::string why;
};

/// An invalid call; its text is for ms_error_text.
struct BadCall {
  std::string text;
};

/// Registers the object and returns its handle.
std::uint64_t keep(std::unique_ptr<Object> object);
/// The object of a handle; null if there is none.
std::shared_ptr<Object> find(std::uint64_t handle);
/// Removes the object; a call that uses it still completes. False if there is none.
bool forget(std::uint64_t handle);

/// Calls `work`, which returns a code, and converts exceptions into a code and a text.
std::int32_t guarded(const std::function<std::int32_t()>& work) noexcept;
/// Keeps the issues for ms_error_text and ms_issue_at; returns the code.
std::int32_t fail(ms_code code, const Issues& issues) noexcept;
std::int32_t fail(ms_code code, const std::string& text) noexcept;

/// Throws BadCall if the pointer is null.
inline void require(const void* pointer, const char* name) {
  if (!pointer) throw BadCall{std::string(name) + " is null"};
}

/// The settings KEY=VALUE of an array; throws BadCall for a null one. The location of a mistake is
/// its key alone.
Settings to_settings(const char* const* texts, std::size_t count);

/// Calls `work` with the object of a handle, if it has the `part` and no other thread uses it.
template <class Part, class Work>
std::int32_t with(std::uint64_t handle, std::unique_ptr<Part> Object::*part, const char* kind,
                  Work&& work) noexcept {
  return guarded([&]() -> std::int32_t {
    const std::shared_ptr<Object> object = find(handle);
    if (!object)
      throw BadCall{std::string("the handle of a ") + kind + " is closed, or was never given"};
    if (!((*object).*part)) throw BadCall{std::string("the handle is not that of a ") + kind};
    const std::unique_lock lock(object->in_use, std::try_to_lock);
    if (!lock) throw BadCall{std::string("another thread uses the ") + kind};
    return work(*((*object).*part), *object);
  });
}
template <class Work>
std::int32_t with_session(std::uint64_t handle, Work&& work) noexcept {
  return with(handle, &Object::session, "session", work);
}
template <class Work>
std::int32_t with_navigator(std::uint64_t handle, Work&& work) noexcept {
  return with(handle, &Object::navigator, "navigator", work);
}
template <class Work>
std::int32_t with_map(std::uint64_t handle, Work&& work) noexcept {
  return with(handle, &Object::map, "map", work);
}

/// Returns positions as x0, y0, x1, ... in the object's buffer.
std::int32_t show(Object& object, std::span<const Vec2> positions, const double** xy,
                  std::size_t* count);

inline constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

}  // namespace microswarm::c
