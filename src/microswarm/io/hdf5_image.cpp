// SPDX-License-Identifier: Apache-2.0
#include "microswarm/io/hdf5_image.hpp"

#include <hdf5.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "microswarm/core/errors/error.hpp"

namespace microswarm {

namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

constexpr hsize_t max_values = 100'000'000;
constexpr hsize_t compressed_from = 4096;  // values; below this, chunks cost more than they save
constexpr hsize_t chunk = 16'384;
constexpr std::size_t image_growth = 1 << 20;  // [bytes]

/// HDF5 identifier that closes itself.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  Id& operator=(Id&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): as HDF5 wants it
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Each use of HDF5 while an instance lives: one thread at a time, and without HDF5's own error
/// printing. It also disables HDF5's clean-up at program exit, which would complain about damaged
/// files; everything here is closed explicitly.
class Use {
 public:
  Use() : lock_(mutex()) {
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  ~Use() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex all;
    return all;
  }

  std::lock_guard<std::recursive_mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// Name of a file in memory. HDF5 takes two open files of one name for the same file.
std::string unused_name() {
  static std::atomic<std::uint64_t> count = 0;
  return "record " + std::to_string(++count);
}

void need(bool done) {
  if (!done) throw InputError("cannot make an HDF5 record");
}

Id text_type(std::size_t size) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(size, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
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

}  // namespace

Hdf5Writer::Hdf5Writer() {
  const Use use;
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, image_growth, false);
  const Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  file_ = H5Fcreate(unused_name().c_str(), H5F_ACC_TRUNC, creation, access);
  need(file_ >= 0);
}

Hdf5Writer::~Hdf5Writer() {
  const Use use;
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::dataset(const std::string& path, std::span<const double> values) {
  const Use use;
  write_column(file_, path, H5T_IEEE_F64LE, values.size(), values.data());
}

void Hdf5Writer::dataset(const std::string& path, std::span<const float> values) {
  const Use use;
  write_column(file_, path, H5T_IEEE_F32LE, values.size(), values.data());
}

void Hdf5Writer::dataset(const std::string& path, std::span<const std::int64_t> values) {
  const Use use;
  write_column(file_, path, H5T_STD_I64LE, values.size(), values.data());
}

void Hdf5Writer::dataset(const std::string& path, std::span<const std::string> values) {
  const Use use;
  std::size_t longest = 1;
  for (const std::string& value : values) longest = std::max(longest, value.size());
  std::string bytes(longest * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(&bytes[i * longest], longest);
  write_column(file_, path, text_type(longest), values.size(), bytes.data());
}

void Hdf5Writer::text(const std::string& path, std::string_view value) {
  const Use use;
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  write_dataset(file_, path, text_type(value.size()), space, 1, std::string(value).c_str());
}

void Hdf5Writer::attribute(const std::string& path, const char* name, std::string_view value) {
  const Use use;
  write_attribute(file_, path, name, text_type(value.size()), std::string(value).c_str());
}

void Hdf5Writer::attribute(const std::string& path, const char* name, double value) {
  const Use use;
  write_attribute(file_, path, name, H5T_IEEE_F64LE, &value);
}

void Hdf5Writer::attribute(const std::string& path, const char* name, std::int64_t value) {
  const Use use;
  write_attribute(file_, path, name, H5T_STD_I64LE, &value);
}

void Hdf5Writer::attribute(const std::string& path, const char* name, std::uint64_t value) {
  const Use use;
  write_attribute(file_, path, name, H5T_STD_U64LE, &value);
}

void Hdf5Writer::group(const std::string& path) {
  const Use use;
  const Id made(H5Gcreate2(file_, path.c_str(), with_parents(), H5P_DEFAULT, H5P_DEFAULT),
                H5Gclose);
  need(made.valid());
}

std::string Hdf5Writer::finish() {
  const Use use;
  need(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  need(size > 0);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  need(H5Fget_file_image(file_, bytes.data(), bytes.size()) == size);
  H5Fclose(std::exchange(file_, -1));
  return bytes;
}

Hdf5Reader::Hdf5Reader(std::string bytes, std::string name)
    : bytes_(std::move(bytes)), name_(std::move(name)) {
  const Use use;
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, image_growth, false);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  if (!bytes_.empty()) H5Pset_file_image(access, bytes_.data(), bytes_.size());
  file_bytes_ = bytes_.size();
  file_ = bytes_.empty() ? -1 : H5Fopen(unused_name().c_str(), H5F_ACC_RDONLY, access);
  if (file_ < 0) fail("no HDF5 file, or a damaged one");
  bytes_.clear();
  bytes_.shrink_to_fit();
}

Hdf5Reader::~Hdf5Reader() {
  const Use use;
  H5Fclose(file_);
}

void Hdf5Reader::fail(const std::string& why) const { throw InputError(name_ + ": " + why); }

namespace {

constexpr hsize_t most_deflated = 1032;  // bytes in one, the most that deflate can do

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

Id open_dataset(const Hdf5Reader& reader, hid_t file, const std::string& path) {
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

Id open_column(const Hdf5Reader& reader, hid_t file, const std::string& path, hsize_t& count) {
  Id set = open_dataset(reader, file, path);
  const Id space(H5Dget_space(set), H5Sclose);
  if (H5Sget_simple_extent_ndims(space) != 1 ||
      H5Sget_simple_extent_dims(space, &count, nullptr) != 1)
    reader.fail(path + " is no column of numbers of its kind");
  if (count > max_values) reader.fail(path + " has more than 100,000,000 values");
  const hsize_t stored = H5Dget_storage_size(set);
  reader.claim(path, stored);
  if (count * sizeof(double) / most_deflated > stored || (count > 0 && stored == 0))
    reader.fail(path + " has fewer values than rows");
  return set;
}

template <class T>
std::vector<T> read_column(const Hdf5Reader& reader, hid_t file, const std::string& path,
                           H5T_class_t kind, hid_t type) {
  const Use use;
  hsize_t count = 0;
  const Id set = open_column(reader, file, path, count);
  const Id stored(H5Dget_type(set), H5Tclose);
  if (H5Tget_class(stored) != kind) reader.fail(path + " is no column of numbers of its kind");
  std::vector<T> values(count);
  if (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    reader.fail(path + " is damaged");
  return values;
}

Id open_attribute(const Hdf5Reader& reader, hid_t file, const std::string& path, const char* name) {
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

void read_attribute(const Hdf5Reader& reader, hid_t file, const std::string& path, const char* name,
                    H5T_class_t kind, hid_t type, void* value) {
  const Use use;
  const Id attribute = open_attribute(reader, file, path, name);
  const Id space(H5Aget_space(attribute), H5Sclose);
  const Id stored(H5Aget_type(attribute), H5Tclose);
  if (H5Sget_simple_extent_npoints(space) != 1 || H5Tget_class(stored) != kind ||
      H5Aread(attribute, type, value) < 0)
    reader.fail("attribute " + std::string(name) + " at " + path + " is of another kind");
}

}  // namespace

void Hdf5Reader::claim(const std::string& path, std::uint64_t stored) const {
  if (!claimed_.insert(path).second) return;
  claimed_bytes_ += stored;
  if (stored > file_bytes_ || claimed_bytes_ > file_bytes_)
    fail(path + ": the datasets hold more than the file");
}

std::size_t Hdf5Reader::length(const std::string& path) const {
  const Use use;
  hsize_t count = 0;
  open_column(*this, file_, path, count);
  return count;
}

std::vector<double> Hdf5Reader::numbers(const std::string& path) const {
  const Use use;
  return read_column<double>(*this, file_, path, H5T_FLOAT, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& path) const {
  const Use use;
  return read_column<std::int64_t>(*this, file_, path, H5T_INTEGER, H5T_NATIVE_INT64);
}

std::string Hdf5Reader::text(const std::string& path) const {
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

bool Hdf5Reader::has_attribute(const std::string& path, const char* name) const {
  const Use use;
  const OwnLinks links;
  return H5Aexists_by_name(file_, path.c_str(), name, links.list()) > 0;
}

std::string Hdf5Reader::text_attribute(const std::string& path, const char* name) const {
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

double Hdf5Reader::number_attribute(const std::string& path, const char* name) const {
  const Use use;
  double value = 0;
  read_attribute(*this, file_, path, name, H5T_FLOAT, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& path, const char* name) const {
  const Use use;
  std::int64_t value = 0;
  read_attribute(*this, file_, path, name, H5T_INTEGER, H5T_NATIVE_INT64, &value);
  return value;
}

}  // namespace microswarm
