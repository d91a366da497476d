// SPDX-License-Identifier: Apache-2.0
#include "microswarm/io/hdf5_image.hpp"

#include <utility>

#include "microswarm/core/execution/module.hpp"

#ifdef MICROSWARM_LINKED_HDF5
/// Linked where no module can be loaded.
extern "C" const microswarm::io::Hdf5* microswarm_hdf5();
#endif

namespace microswarm::io {
namespace {

const Hdf5& hdf5() {
#ifdef MICROSWARM_LINKED_HDF5
  return *microswarm_hdf5();
#else
  static const Hdf5& loaded =
      *reinterpret_cast<const Hdf5* (*)()>(load_module("hdf5", "records and trees"))();
  return loaded;
#endif
}

}  // namespace

std::unique_ptr<Hdf5Writer> write_hdf5() { return hdf5().write(); }

std::unique_ptr<Hdf5Reader> read_hdf5(std::string bytes, std::string name) {
  return hdf5().read(std::move(bytes), std::move(name));
}

}  // namespace microswarm::io
