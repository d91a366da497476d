// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "calls.hpp"
#include "microswarm/report/run_picture.hpp"

namespace microswarm::python {

/// Draws without the GIL. Writes the picture into `file`, or returns it as PNG if there is none.
template <class Draw>
py::object drawn(const std::optional<std::string>& file, Draw&& draw) {
  const std::string png = interruptible([&](const Stop&) {
    const std::unique_ptr<report::Picture> picture = draw();
    if (!file) return picture->png();
    picture->write(*file);
    return std::string();
  });
  return file ? py::object(py::none()) : py::object(py::bytes(png));
}

}  // namespace microswarm::python
