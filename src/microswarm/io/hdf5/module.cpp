// SPDX-License-Identifier: Apache-2.0
// libmicroswarm_hdf5.so: all that is linked with HDF5.
#include "microswarm/io/hdf5/module.hpp"

#include <utility>

namespace microswarm::io {
namespace {

class LinkedHdf5 : public Hdf5 {
 public:
  std::unique_ptr<Hdf5Writer> write() const override { return make_image_writer(); }
  std::unique_ptr<Hdf5Reader> read(std::string bytes, std::string name) const override {
    return make_image_reader(std::move(bytes), std::move(name));
  }
};

}  // namespace
}  // namespace microswarm::io

/// Symbol that write_hdf5 and read_hdf5 look up.
extern "C" const microswarm::io::Hdf5* microswarm_hdf5() {
  static const microswarm::io::LinkedHdf5 only;
  return &only;
}
