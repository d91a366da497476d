// SPDX-License-Identifier: Apache-2.0
#include "microswarm/io/hdf5_image.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/files.hpp"

namespace microswarm::io {
namespace {

TEST(Hdf5Image, ColumnsOfEverySizeComeBack) {
  for (const std::size_t count : {0, 1, 2, 4095, 4096, 4097, 16'383, 16'384, 16'385, 50'000}) {
    std::vector<double> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0.25);
    std::vector<std::int64_t> integers(count);
    std::iota(integers.begin(), integers.end(), -7);
    const auto made = write_hdf5();
    Hdf5Writer& out = *made;
    out.dataset("/a/b/numbers", numbers);
    out.dataset("/a/integers", integers);
    const auto opened = read_hdf5(out.finish(), "x.h5");
    const Hdf5Reader& in = *opened;
    EXPECT_EQ(in.numbers("/a/b/numbers"), numbers) << count;
    EXPECT_EQ(in.integers("/a/integers"), integers) << count;
  }
}

TEST(Hdf5Image, TextsAndAttributesComeBack) {
  const auto made = write_hdf5();
  Hdf5Writer& out = *made;
  out.text("/text", "line\nµm\n");
  out.text("/none", "");
  out.group("/group");
  out.attribute("/group", "word", "µm");
  out.attribute("/group", "nothing", "");
  out.attribute("/group", "number", 0.1);
  out.attribute("/group", "integer", std::int64_t{-3});
  out.attribute("/", "seed", ~std::uint64_t{0});
  const auto opened = read_hdf5(out.finish(), "x.h5");
  const Hdf5Reader& in = *opened;
  EXPECT_EQ(in.text("/text"), "line\nµm\n");
  EXPECT_EQ(in.text("/none"), "");
  EXPECT_EQ(in.text_attribute("/group", "word"), "µm");
  EXPECT_EQ(in.text_attribute("/group", "nothing"), "");
  EXPECT_EQ(in.number_attribute("/group", "number"), 0.1);
  EXPECT_EQ(in.integer_attribute("/group", "integer"), -3);
}

TEST(Hdf5Image, WhatIsMissingOrOfAnotherKindIsNamed) {
  const auto made = write_hdf5();
  Hdf5Writer& out = *made;
  out.dataset("/numbers", std::vector<double>{1, 2});
  out.attribute("/numbers", "unit", "s");
  const auto opened = read_hdf5(out.finish(), "x.h5");
  const Hdf5Reader& in = *opened;
  EXPECT_EQ(test::error_of([&] { in.numbers("/other"); }), "x.h5: has no dataset /other");
  EXPECT_EQ(test::issues_of([&] { in.numbers("/other"); })[0].location, "x.h5");
  EXPECT_EQ(test::error_of([&] { in.integers("/numbers"); }),
            "x.h5: /numbers is no column of numbers of its kind");
  EXPECT_EQ(test::error_of([&] { in.text("/numbers"); }),
            "x.h5: /numbers is no text of fixed length");
  EXPECT_EQ(test::error_of([&] { in.number_attribute("/numbers", "unit"); }),
            "x.h5: attribute unit at /numbers is of another kind");
  EXPECT_EQ(test::error_of([&] { in.text_attribute("/numbers", "name"); }),
            "x.h5: has no attribute name at /numbers");
}

TEST(Hdf5Image, SeveralAreOpenAtATime) {
  const auto first_file = write_hdf5(), second_file = write_hdf5();
  Hdf5Writer &first = *first_file, &second = *second_file;
  first.dataset("/column", std::vector<double>{1});
  second.dataset("/column", std::vector<double>{2});
  const auto a_file = read_hdf5(first.finish(), "a.h5"),
             b_file = read_hdf5(second.finish(), "b.h5");
  const Hdf5Reader &a = *a_file, &b = *b_file;
  EXPECT_EQ(a.numbers("/column"), std::vector<double>{1});
  EXPECT_EQ(b.numbers("/column"), std::vector<double>{2});
}

}  // namespace
}  // namespace microswarm::io
