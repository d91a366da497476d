// SPDX-License-Identifier: Apache-2.0
// Replaces record_watch.cpp where no other program runs: a record does not grow.
#include <utility>

#include "lab/sessions/record_watch.hpp"

namespace microswarm::lab {

RecordWatch::RecordWatch(std::filesystem::path file) : part_(std::move(file)) {}

std::filesystem::path RecordWatch::file() const { return part_; }

bool RecordWatch::is_growing() const { return false; }

bool RecordWatch::has_changed() { return false; }

}  // namespace microswarm::lab
