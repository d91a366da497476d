// SPDX-License-Identifier: Apache-2.0
#include "pictures.hpp"

#include <algorithm>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/images/samples.hpp"

namespace microswarm::python {
namespace {

template <class Sample>
formats::Samples2d<Sample> to_samples(const py::array& array) {
  return {{static_cast<const Sample*>(array.data()), static_cast<std::size_t>(array.size())},
          static_cast<int>(array.shape(1)),
          static_cast<int>(array.shape(0)),
          array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1};
}

}  // namespace

void take_array(const py::array& array, std::optional<int>& depth, std::string_view name,
                formats::Image& image) {
  const bool is_picture = array.ndim() == 2 || array.ndim() == 3;
  const auto bytes = array.itemsize();
  if (!is_picture || array.dtype().kind() != 'u' || bytes > 2 ||
      (array.flags() & py::array::c_style) == 0)
    throw InputError(std::string(name) + " must be a picture of uint8 or uint16");
  formats::check_image_size(array.shape(1), array.shape(0), name);
  if (bytes == 1) {
    formats::take_samples(to_samples<std::uint8_t>(array), name, image);
    return;
  }
  const auto samples = to_samples<std::uint16_t>(array);
  if (!depth) depth = formats::used_depth(samples.samples);
  formats::take_samples(samples, *depth, name, image);
}

py::array_t<bool> to_array(const formats::Mask& mask) {
  py::array_t<bool> array(
      {static_cast<py::ssize_t>(mask.height), static_cast<py::ssize_t>(mask.width)});
  std::ranges::transform(mask.cells, array.mutable_data(),
                         [](std::uint8_t cell) { return cell != 0; });
  return array;
}

}  // namespace microswarm::python
