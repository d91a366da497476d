// SPDX-License-Identifier: Apache-2.0
// HDF5 files that name other files, or more rows than they hold.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <functional>

#include "microswarm/io/hdf5_image.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::io {
namespace {

using test::error_of;
using test::is_one_line_naming;

/// A file made by HDF5 itself, and what reading the column /a says.
class ForeignHdf5 : public testing::Test {
 protected:
  std::string complaint(const std::function<void(hid_t)>& make) {
    const hid_t made =
        H5Fcreate((folder / "x.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    make(made);
    H5Fclose(made);
    return error_of([&] { read_hdf5(read_file(folder / "x.h5"), "x.h5")->numbers("/a"); });
  }
  static void create(hid_t file, const char* name, hsize_t count, hid_t properties,
                     hid_t type = H5T_IEEE_F64LE) {
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    H5Dclose(H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    H5Sclose(space);
    H5Pclose(properties);
  }
  /// Chunked and packed, and filled with zeros where `filled`.
  static void create_chunked(hid_t file, const char* name, hsize_t count, bool filled) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = std::min<hsize_t>(count, 1'000'000);
    H5Pset_chunk(properties, 1, &chunk);
    H5Pset_deflate(properties, 9);
    if (filled) H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY);
    create(file, name, count, properties);
  }
  test::Folder folder;
};

TEST_F(ForeignHdf5, ExternalValuesAreRefused) {
  const auto secret = folder.with("secret", std::string(800, 's'));
  EXPECT_TRUE(is_one_line_naming(complaint([&](hid_t file) {
                                   const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
                                   H5Pset_external(properties, secret.c_str(), 0, 800);
                                   create(file, "/a", 100, properties);
                                 }),
                                 "x.h5", {"/a", "another file"}));
}

TEST_F(ForeignHdf5, VirtualDatasetsAreRefused) {
  EXPECT_TRUE(is_one_line_naming(complaint([&](hid_t file) {
                                   const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
                                   const hsize_t count = 100;
                                   const hid_t space = H5Screate_simple(1, &count, nullptr);
                                   H5Pset_virtual(properties, space, (folder / "other.h5").c_str(),
                                                  "/a", space);
                                   H5Sclose(space);
                                   create(file, "/a", count, properties);
                                 }),
                                 "x.h5", {"/a", "another file"}));
}

TEST_F(ForeignHdf5, LinksToOtherFilesAreRefused) {
  const auto made = write_hdf5();
  Hdf5Writer& other = *made;
  other.dataset("/a", std::vector<double>{1, 2, 3});
  const auto path = folder.with("other.h5", other.finish());
  EXPECT_TRUE(is_one_line_naming(complaint([&](hid_t file) {
                                   H5Lcreate_external(path.c_str(), "/a", file, "/a", H5P_DEFAULT,
                                                      H5P_DEFAULT);
                                 }),
                                 "x.h5", {"/a", "another file"}));
  EXPECT_TRUE(is_one_line_naming(complaint([&](hid_t file) {
                                   H5Lcreate_external(path.c_str(), "/a", file, "/b", H5P_DEFAULT,
                                                      H5P_DEFAULT);
                                   H5Lcreate_soft("/b", file, "/a", H5P_DEFAULT, H5P_DEFAULT);
                                 }),
                                 "x.h5", {"/a", "another file"}));
}

TEST_F(ForeignHdf5, RowsNeedStorage) {
  EXPECT_TRUE(is_one_line_naming(
      complaint([](hid_t file) { create_chunked(file, "/a", 99'000'000, false); }), "x.h5",
      {"/a", "fewer values than rows"}));
  EXPECT_TRUE(is_one_line_naming(
      complaint([](hid_t file) { create(file, "/a", 99'000'000, H5Pcreate(H5P_DATASET_CREATE)); }),
      "x.h5", {"/a", "fewer values than rows"}));
}

TEST_F(ForeignHdf5, NumbersAreNotWiderThanTheyCanBe) {
  const hid_t wide = H5Tcopy(H5T_IEEE_F64LE);
  H5Tset_size(wide, 1'000'000);
  EXPECT_TRUE(is_one_line_naming(complaint([&](hid_t file) {
                                   const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
                                   H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY);
                                   create(file, "/a", 3, properties, wide);
                                 }),
                                 "x.h5", {"/a", "no column of numbers"}));
  H5Tclose(wide);
}

TEST_F(ForeignHdf5, PackedZerosAreRead) {
  EXPECT_EQ(complaint([](hid_t file) { create_chunked(file, "/a", 1'000'000, true); }),
            "nothing was thrown");
}

TEST_F(ForeignHdf5, DatasetsDoNotShareStorage) {
  complaint([](hid_t file) {
    create_chunked(file, "/a", 20'000'000, true);
    for (const char* name : {"/b", "/c", "/d"})
      H5Lcreate_hard(file, "/a", file, name, H5P_DEFAULT, H5P_DEFAULT);
  });
  const auto opened = read_hdf5(read_file(folder / "x.h5"), "x.h5");
  const Hdf5Reader& in = *opened;
  in.length("/a");
  EXPECT_TRUE(is_one_line_naming(error_of([&] {
                                   for (const char* name : {"/b", "/c", "/d"}) in.length(name);
                                 }),
                                 "x.h5", {"more than the file"}));
}

TEST_F(ForeignHdf5, UnknownFiltersAreRefused) {
  EXPECT_TRUE(is_one_line_naming(complaint([](hid_t file) {
                                   const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
                                   const hsize_t chunk = 10;
                                   H5Pset_chunk(properties, 1, &chunk);
                                   H5Pset_deflate(properties, 9);
                                   H5Pset_deflate(properties, 9);
                                   create(file, "/a", 10, properties);
                                 }),
                                 "x.h5", {"/a", "packed"}));
}

}  // namespace
}  // namespace microswarm::io
