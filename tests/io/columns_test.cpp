// SPDX-License-Identifier: Apache-2.0
#include "microswarm/io/columns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/io/hdf5_tables.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm::io {
namespace {

enum class Mood { calm, cross };
constexpr auto enum_names(Mood) {
  return std::array<std::pair<Mood, std::string_view>, 2>{
      {{Mood::calm, "calm"}, {Mood::cross, "cross"}}};
}

struct Inner {
  double depth = 0;
  int count = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.depth, um("depth", "How deep."));
    visit(self.count, plain("count", "How many."));
  }
};

struct Row {
  double t = 0;
  double turn = 0;
  std::optional<Pose2> seen;
  std::optional<Vec2> target;
  Inner inner;
  Mood mood = Mood::calm;
  bool is_last = false;
  std::uint32_t index = 0;
  std::optional<std::uint32_t> partner;
  std::vector<Vec2> points;
  std::vector<Inner> parts;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "When."));
    visit(self.turn, deg("turn", "Turning."));
    visit(self.seen, plain("seen", "What was seen."));
    visit(self.target, um("target", "Target."));
    visit(self.inner, plain("inner", "Inside."));
    visit(self.mood, plain("mood", "Mood."));
    visit(self.is_last, plain("is_last", "Last."));
    visit(self.index, plain("index", "Index."));
    visit(self.partner, plain("partner", "Partner."));
    visit(self.points, um("points", "Points."));
    visit(self.parts, plain("parts", "Parts."));
  }
};

struct Results {
  std::vector<Row> rows;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.rows, plain("rows", "Rows."));
  }
};

/// A table, and the same before columns were added to it.
struct FormerMove {
  double t = 0;
  double turn = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "When."));
    visit(self.turn, deg("turn", "Turning."));
  }
};
struct Move {
  double t = 0;
  bool is_led = true;
  std::optional<Vec2> target;
  double turn = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "When."));
    visit(self.is_led, plain("is_led", "Led."));
    visit(self.target, um("target", "Target."));
    visit(self.turn, deg("turn", "Turning."));
  }
};
template <class Row>
struct Moves {
  std::vector<Row> moves;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.moves, plain("moves", "Moves."));
  }
};

Row full_row() {
  return {.t = 2,
          .turn = std::numbers::pi / 2,
          .seen = Pose2{{1, 2}, 0.5},
          .target = Vec2{3, 4},
          .inner = {.depth = 5, .count = 6},
          .mood = Mood::cross,
          .is_last = true,
          .index = 7,
          .partner = 3,
          .points = {{8, 9}, {10, 11}},
          .parts = {{.depth = 12, .count = 13}}};
}

const Column& column_of(const std::vector<Column>& columns, std::string_view key) {
  for (const Column& column : columns)
    if (column.key == key) return column;
  throw InputError("no column " + std::string(key));
}

TEST(Columns, AreTheLeavesOfTheFields) {
  EXPECT_EQ(csv_head(to_columns<Row>()),
            "t_s,turn_rad,seen_x_um,seen_y_um,seen_heading_rad,target_x_um,target_y_um,"
            "inner_depth_um,inner_count,mood,is_last,index,partner");
  const std::vector<Column> columns = to_columns<Row>();
  EXPECT_EQ(column_of(columns, "inner_depth_um").doc, "Inside: how deep.");
  EXPECT_EQ(column_of(columns, "mood").kind, ColumnKind::word);
  EXPECT_EQ(column_of(columns, "index").kind, ColumnKind::integer);
  const Row row = full_row();
  EXPECT_EQ(column_of(columns, "inner_count").number(&row), 6);
  EXPECT_EQ(column_of(to_columns<Row>(ColumnUnits::shown), "turn_deg").number(&row), 90);
}

TEST(Columns, WhatIsMissingIsNoNumberAndAnEmptyText) {
  const std::vector<Column> columns = to_columns<Row>();
  const Row none;
  EXPECT_TRUE(std::isnan(column_of(columns, "seen_x_um").number(&none)));
  EXPECT_EQ(csv_line(columns, &none), "0,0,,,,,,0,0,calm,0,0,");
  Row row;
  EXPECT_TRUE(column_of(columns, "target_y_um").set_number(&row, std::nan("")));
  EXPECT_FALSE(row.target);
  EXPECT_TRUE(column_of(columns, "target_y_um").set_number(&row, 4));
  EXPECT_EQ(row.target->y, 4);
  const Column& partner = column_of(columns, "partner");
  EXPECT_EQ(partner.integer(&none), -1);
  EXPECT_TRUE(partner.set_integer(&row, -1));
  EXPECT_FALSE(row.partner);
  EXPECT_TRUE(partner.set_integer(&row, 2));
  EXPECT_EQ(row.partner, 2u);
  EXPECT_EQ(partner.integer(&row), 2);
}

TEST(Columns, WhatIsOutOfRangeIsRefused) {
  const std::vector<Column> columns = to_columns<Row>();
  Row row;
  EXPECT_FALSE(column_of(columns, "is_last").set_number(&row, 2));
  EXPECT_FALSE(column_of(columns, "index").set_number(&row, -1));
  EXPECT_FALSE(column_of(columns, "index").set_integer(&row, -1));
  EXPECT_FALSE(column_of(columns, "partner").set_integer(&row, -2));
  EXPECT_FALSE(column_of(columns, "index").set_number(&row, 4294967296.0));
  EXPECT_TRUE(column_of(columns, "index").set_number(&row, 4294967295.0));
  EXPECT_FALSE(column_of(columns, "mood").set_word(&row, "glad"));
}

TEST(Tables, ComeBackFromHdf5) {
  Results results;
  results.rows = {full_row(), Row{}, full_row()};
  results.rows[2].parts.clear();
  const auto made = write_hdf5();
  Hdf5Writer& out = *made;
  write_tables(out, type_of<Results>(), &results);
  const auto opened = read_hdf5(out.finish(), "x.h5");
  const Hdf5Reader& in = *opened;
  Results read;
  read_tables(in, type_of<Results>(), &read);
  ASSERT_EQ(read.rows.size(), 3u);
  EXPECT_EQ(csv_line(to_columns<Row>(), &read.rows[0]),
            csv_line(to_columns<Row>(), &results.rows[0]));
  EXPECT_FALSE(read.rows[1].seen);
  EXPECT_EQ(read.rows[0].partner, 3u);
  EXPECT_FALSE(read.rows[1].partner);
  EXPECT_EQ(read.rows[0].points, results.rows[0].points);
  EXPECT_TRUE(read.rows[1].points.empty());
  EXPECT_EQ(read.rows[0].parts[0].count, 13);
  EXPECT_TRUE(read.rows[2].parts.empty());
}

TEST(Tables, ColumnsThatFormerFilesLackHaveTheValuesOfTheirType) {
  const Moves<FormerMove> former{.moves = {{1, 0.5}, {2, 0.25}}};
  const auto made = write_hdf5();
  write_table(*made, type_of<Moves<FormerMove>>().fields[0], &former, "/g");
  const auto opened = read_hdf5(made->finish(), "x.h5");
  Moves<Move> read;
  read_table(*opened, type_of<Moves<Move>>().fields[0], &read, "/g");
  ASSERT_EQ(read.moves.size(), 2u);
  EXPECT_EQ(read.moves[1].t, 2);
  EXPECT_NEAR(read.moves[1].turn, 0.25, 1e-12);
  EXPECT_TRUE(read.moves[1].is_led);
  EXPECT_FALSE(read.moves[1].target);
}

}  // namespace
}  // namespace microswarm::io
