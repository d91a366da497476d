// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "microswarm/io/hdf5_image.hpp"

namespace microswarm::io {

/// As write_hdf5 and read_hdf5, within the module.
std::unique_ptr<Hdf5Writer> make_image_writer();
std::unique_ptr<Hdf5Reader> make_image_reader(std::string bytes, std::string name);

}  // namespace microswarm::io
