// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>
#include <utility>

#include "microswarm/io/hdf5/library.hpp"
#include "microswarm/io/hdf5/module.hpp"

namespace microswarm::io {
namespace {

/// Reads from a file that HDF5 keeps in memory.
class ImageReader : public Hdf5Reader {
 public:
  ImageReader(std::string bytes, std::string name);
  ~ImageReader() override;
  ImageReader(const ImageReader&) = delete;
  ImageReader& operator=(const ImageReader&) = delete;

  std::size_t length(const std::string& path) const override;
  std::vector<double> numbers(const std::string& path) const override;
  std::vector<std::int64_t> integers(const std::string& path) const override;
  std::string text(const std::string& path) const override;

  bool has_attribute(const std::string& path, const char* name) const override;
  std::string text_attribute(const std::string& path, const char* name) const override;
  double number_attribute(const std::string& path, const char* name) const override;
  std::int64_t integer_attribute(const std::string& path, const char* name) const override;

  /// Counts the stored bytes of a dataset once. Throws if all of them are more than the file.
  void claim(const std::string& path, std::uint64_t stored) const;

 private:
  hid_t file_;
  std::uint64_t file_bytes_ = 0;
  mutable std::set<std::string> claimed_;
  mutable std::uint64_t claimed_bytes_ = 0;
};

constexpr hsize_t max_deflation = 1032;  // bytes in one, the most that deflate can do

herr_t refuse_other_file(const char*, const char*, const char*, const char*, unsigned*, hid_t,
                         void* asked) {
  *static_cast<bool*>(asked) = true;
  return -1;
}

/// Access to datasets and attributes of this file only.
class OwnLinks {
 public:
  OwnLinks() : list_(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose) {
    H5Pset_elink_cb(list_, refuse_other_file, &asked_);
  }
  ~OwnLinks() = default;
  OwnLinks(const OwnLinks&) = delete;
  OwnLinks& operator=(const OwnLinks&) = delete;
  hid_t list() const { return list_; }
  /// Whether a link to another file was met.
  bool met_other_file() const { return asked_; }

 private:
  Id list_;
  bool asked_ = false;
};

/// Whether the bytes pass through nothing but one deflate, a shuffle and a check sum. Other filters
/// could be loaded from a folder of plug-ins.
bool has_known_filters(hid_t properties) {
  int deflates = 0;
  for (int i = 0; i < H5Pget_nfilters(properties); ++i) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    switch (H5Pget_filter2(properties, static_cast<unsigned>(i), &flags, &values, nullptr, 0,
                           nullptr, &config)) {
      case H5Z_FILTER_DEFLATE:
        ++deflates;
        break;
      case H5Z_FILTER_SHUFFLE:
      case H5Z_FILTER_FLETCHER32:
        break;
      default:
        return false;
    }
  }
  return deflates <= 1;
}

Id open_dataset(const ImageReader& reader, hid_t file, const std::string& path) {
  const OwnLinks links;
  Id set(H5Dopen2(file, path.c_str(), links.list()), H5Dclose);
  if (links.met_other_file()) reader.fail(path + " is in another file");
  if (!set.valid()) reader.fail("has no dataset " + path);
  const Id properties(H5Dget_create_plist(set), H5Pclose);
  if (!properties.valid() || H5Pget_external_count(properties) != 0 ||
      H5Pget_layout(properties) == H5D_VIRTUAL)
    reader.fail(path + " has its values in another file");
  if (!has_known_filters(properties)) reader.fail(path + " is packed in an unknown way");
  return set;
}

Id open_column(const ImageReader& reader, hid_t file, const std::string& path, hsize_t& count) {
  Id set = open_dataset(reader, file, path);
  const Id space(H5Dget_space(set), H5Sclose);
  if (H5Sget_simple_extent_ndims(space) != 1 ||
      H5Sget_simple_extent_dims(space, &count, nullptr) != 1)
    reader.fail(path + " is no column of numbers of its kind");
  if (count > max_values) reader.fail(path + " has more than 100,000,000 values");
  const hsize_t stored = H5Dget_storage_size(set);
  reader.claim(path, stored);
  if (count * sizeof(double) / max_deflation > stored || (count > 0 && stored == 0))
    reader.fail(path + " has fewer values than rows");
  return set;
}

/// Whether a type is of this class and not wider than a number: HDF5 converts values through a
/// buffer for them, which a damaged width makes gigabytes.
bool is_number(hid_t type, H5T_class_t kind) {
  return H5Tget_class(type) == kind && H5Tget_size(type) <= sizeof(double);
}

template <class T>
std::vector<T> read_column(const ImageReader& reader, hid_t file, const std::string& path,
                           H5T_class_t kind, hid_t type) {
  const Use use;
  hsize_t count = 0;
  const Id set = open_column(reader, file, path, count);
  const Id stored(H5Dget_type(set), H5Tclose);
  if (!is_number(stored, kind)) reader.fail(path + " is no column of numbers of its kind");
  std::vector<T> values(count);
  if (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    reader.fail(path + " is damaged");
  return values;
}

Id open_attribute(const ImageReader& reader, hid_t file, const std::string& path,
                  const char* name) {
  const OwnLinks links;
  Id attribute(H5Aopen_by_name(file, path.c_str(), name, H5P_DEFAULT, links.list()), H5Aclose);
  if (links.met_other_file()) reader.fail(path + " is in another file");
  if (!attribute.valid()) reader.fail("has no attribute " + std::string(name) + " at " + path);
  return attribute;
}

/// Size of a fixed-length text type; 0 for anything else.
std::size_t text_size(hid_t type) {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) return 0;
  const std::size_t size = H5Tget_size(type);
  return size <= max_values ? size : 0;
}

std::string unpadded(std::string text) {
  text.resize(std::min(text.size(), text.find('\0')));
  return text;
}

void read_attribute(const ImageReader& reader, hid_t file, const std::string& path,
                    const char* name, H5T_class_t kind, hid_t type, void* value) {
  const Use use;
  const Id attribute = open_attribute(reader, file, path, name);
  const Id space(H5Aget_space(attribute), H5Sclose);
  const Id stored(H5Aget_type(attribute), H5Tclose);
  if (H5Sget_simple_extent_npoints(space) != 1 || !is_number(stored, kind) ||
      H5Aread(attribute, type, value) < 0)
    reader.fail("attribute " + std::string(name) + " at " + path + " is of another kind");
}

ImageReader::ImageReader(std::string bytes, std::string name) : Hdf5Reader(std::move(name)) {
  const Use use;
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, image_growth, false);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  if (!bytes.empty()) H5Pset_file_image(access, bytes.data(), bytes.size());
  file_bytes_ = bytes.size();
  file_ = bytes.empty() ? -1 : H5Fopen(unused_name().c_str(), H5F_ACC_RDONLY, access);
  if (file_ < 0) fail("no HDF5 file, or a damaged one");
}

ImageReader::~ImageReader() {
  const Use use;
  H5Fclose(file_);
}

void ImageReader::claim(const std::string& path, std::uint64_t stored) const {
  if (!claimed_.insert(path).second) return;
  claimed_bytes_ += stored;
  if (stored > file_bytes_ || claimed_bytes_ > file_bytes_)
    fail(path + ": the datasets hold more than the file");
}

std::size_t ImageReader::length(const std::string& path) const {
  const Use use;
  hsize_t count = 0;
  open_column(*this, file_, path, count);
  return count;
}

std::vector<double> ImageReader::numbers(const std::string& path) const {
  const Use use;
  return read_column<double>(*this, file_, path, H5T_FLOAT, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> ImageReader::integers(const std::string& path) const {
  const Use use;
  return read_column<std::int64_t>(*this, file_, path, H5T_INTEGER, H5T_NATIVE_INT64);
}

std::string ImageReader::text(const std::string& path) const {
  const Use use;
  const Id set = open_dataset(*this, file_, path);
  const Id space(H5Dget_space(set), H5Sclose);
  const Id type(H5Dget_type(set), H5Tclose);
  const std::size_t size = text_size(type);
  if (size > H5Dget_storage_size(set)) fail(path + " has less text than it says");
  claim(path, size);
  std::string value(size, '\0');
  if (value.empty() || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0)
    fail(path + " is no text of fixed length");
  return unpadded(std::move(value));
}

bool ImageReader::has_attribute(const std::string& path, const char* name) const {
  const Use use;
  const OwnLinks links;
  return H5Aexists_by_name(file_, path.c_str(), name, links.list()) > 0;
}

std::string ImageReader::text_attribute(const std::string& path, const char* name) const {
  const Use use;
  const Id attribute = open_attribute(*this, file_, path, name);
  const Id space(H5Aget_space(attribute), H5Sclose);
  const Id type(H5Aget_type(attribute), H5Tclose);
  const std::size_t size = text_size(type);
  std::string value(size <= file_bytes_ ? size : 0, '\0');
  if (value.empty() || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(attribute, type, value.data()) < 0)
    fail("attribute " + std::string(name) + " at " + path + " is no text of fixed length");
  return unpadded(std::move(value));
}

double ImageReader::number_attribute(const std::string& path, const char* name) const {
  const Use use;
  double value = 0;
  read_attribute(*this, file_, path, name, H5T_FLOAT, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::int64_t ImageReader::integer_attribute(const std::string& path, const char* name) const {
  const Use use;
  std::int64_t value = 0;
  read_attribute(*this, file_, path, name, H5T_INTEGER, H5T_NATIVE_INT64, &value);
  return value;
}

}  // namespace

std::unique_ptr<Hdf5Reader> make_image_reader(std::string bytes, std::string name) {
  return std::make_unique<ImageReader>(std::move(bytes), std::move(name));
}

}  // namespace microswarm::io
