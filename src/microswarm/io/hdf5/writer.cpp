// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/io/hdf5/library.hpp"
#include "microswarm/io/hdf5/module.hpp"

namespace microswarm::io {
namespace {

constexpr hsize_t compressed_from = 4096;  // values; below this, chunks cost more than they save
constexpr hsize_t chunk = 16'384;

void need(bool done) {
  if (!done) throw InputError("cannot make an HDF5 record");
}

/// UTF-8 only where it is needed: Octave cannot read it.
H5T_cset_t character_set(std::string_view text) {
  const bool plain = std::ranges::all_of(text, [](char c) { return (c & 0x80) == 0; });
  return plain ? H5T_CSET_ASCII : H5T_CSET_UTF8;
}

Id text_type(std::size_t size, H5T_cset_t characters) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(size, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, characters);
  return type;
}

Id with_parents() {
  Id list(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

Id dataset_properties(hsize_t count) {
  Id list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(list, false);
  if (count >= compressed_from) {
    const hsize_t whole = std::min(chunk, count);  // a chunk may not be larger than its dataset
    H5Pset_chunk(list, 1, &whole);
    H5Pset_shuffle(list);
    H5Pset_deflate(list, 4);
  }
  return list;
}

void write_dataset(hid_t file, const std::string& path, hid_t type, hid_t space, hsize_t count,
                   const void* values) {
  const Id set(H5Dcreate2(file, path.c_str(), type, space, with_parents(),
                          dataset_properties(count), H5P_DEFAULT),
               H5Dclose);
  need(set.valid());
  if (count > 0) need(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
}

void write_column(hid_t file, const std::string& path, hid_t type, hsize_t count,
                  const void* values) {
  const Use use;
  const Id space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  write_dataset(file, path, type, space, count, values);
}

void write_attribute(hid_t file, const std::string& path, const char* name, hid_t type,
                     const void* value) {
  const Use use;
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Id attribute(H5Acreate_by_name(file, path.c_str(), name, type, space, H5P_DEFAULT,
                                       H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose);
  need(attribute.valid());
  need(H5Awrite(attribute, type, value) >= 0);
}

/// Writes into a file that HDF5 keeps in memory.
class ImageWriter : public Hdf5Writer {
 public:
  ImageWriter() {
    const Use use;
    const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, image_growth, false);
    const Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    file_ = H5Fcreate(unused_name().c_str(), H5F_ACC_TRUNC, creation, access);
    need(file_ >= 0);
  }

  ImageWriter(const ImageWriter&) = delete;
  ImageWriter& operator=(const ImageWriter&) = delete;
  ~ImageWriter() override {
    const Use use;
    if (file_ >= 0) H5Fclose(file_);
  }

  void dataset(const std::string& path, std::span<const double> values) override {
    const Use use;
    write_column(file_, path, H5T_IEEE_F64LE, values.size(), values.data());
  }

  void dataset(const std::string& path, std::span<const float> values) override {
    const Use use;
    write_column(file_, path, H5T_IEEE_F32LE, values.size(), values.data());
  }

  void dataset(const std::string& path, std::span<const std::int64_t> values) override {
    const Use use;
    write_column(file_, path, H5T_STD_I64LE, values.size(), values.data());
  }

  void dataset(const std::string& path, std::span<const std::string> values) override {
    const Use use;
    std::size_t longest = 1;
    for (const std::string& value : values) longest = std::max(longest, value.size());
    std::string bytes(longest * values.size(), '\0');
    for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(&bytes[i * longest], longest);
    write_column(file_, path, text_type(longest, character_set(bytes)), values.size(),
                 bytes.data());
  }

  void text(const std::string& path, std::string_view value) override {
    const Use use;
    const Id space(H5Screate(H5S_SCALAR), H5Sclose);
    const Id type = text_type(value.size(), character_set(value));
    write_dataset(file_, path, type, space, 1, std::string(value).c_str());
  }

  void attribute(const std::string& path, const char* name, std::string_view value) override {
    const Use use;
    const Id type = text_type(value.size(), character_set(value));
    write_attribute(file_, path, name, type, std::string(value).c_str());
  }

  void attribute(const std::string& path, const char* name, double value) override {
    const Use use;
    write_attribute(file_, path, name, H5T_IEEE_F64LE, &value);
  }

  void attribute(const std::string& path, const char* name, std::int64_t value) override {
    const Use use;
    write_attribute(file_, path, name, H5T_STD_I64LE, &value);
  }

  void attribute(const std::string& path, const char* name, std::uint64_t value) override {
    const Use use;
    write_attribute(file_, path, name, H5T_STD_U64LE, &value);
  }

  void group(const std::string& path) override {
    const Use use;
    const Id made(H5Gcreate2(file_, path.c_str(), with_parents(), H5P_DEFAULT, H5P_DEFAULT),
                  H5Gclose);
    need(made.valid());
  }

  std::string finish() override {
    const Use use;
    need(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    need(size > 0);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    need(H5Fget_file_image(file_, bytes.data(), bytes.size()) == size);
    H5Fclose(std::exchange(file_, -1));
    return bytes;
  }

 private:
  hid_t file_;
};

}  // namespace

std::unique_ptr<Hdf5Writer> make_image_writer() { return std::make_unique<ImageWriter>(); }

}  // namespace microswarm::io
