// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/text/choices.hpp"
#include "microswarm/core/text/csv.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm {
namespace {

TEST(Text, NumbersAreShort) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.0), "-0");
  EXPECT_EQ(number_text(60), "60");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1e5), "1e5");
  EXPECT_EQ(number_text(1e-7), "1e-7");
  EXPECT_EQ(number_text(-2.5e-10), "-2.5e-10");
  EXPECT_EQ(number_text(123456789), "123456789");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Text, ControlCharactersDoNotPass) {
  EXPECT_EQ(printable("µm → 1\n\ttab 𝛿"), "µm → 1\n\ttab 𝛿");
  EXPECT_EQ(printable("a\x1b[31mb\rc\x7f"), "a?[31mb?c?");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m \xc2\xa0"),
            "?31m \xc2\xa0");
  EXPECT_EQ(printable("a\u202eb\u2066c\u200f"), "a?b?c?");
  // No UTF-8: cut short, too long a form, a surrogate, beyond the last character.
  EXPECT_EQ(printable("\xe2\x82"), "??");
  EXPECT_EQ(printable("\xc0\xaf"), "??");
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");
  EXPECT_EQ(printable("\xff"), "?");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "?");
  EXPECT_EQ(one_line("a\nb\x1b"), "a?b?");
}

TEST(Text, NumbersReadBackToTheSameBits) {
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 100'000; ++i) {
    const double value = std::bit_cast<double>(rng.bits());
    if (!std::isfinite(value)) continue;
    const auto back = parse_number(number_text(value));
    ASSERT_TRUE(back) << number_text(value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(Text, OnlyFiniteDecimalsAreNumbers) {
  for (std::string_view good : {"0", "-1", "+1", "1.", ".5", "1e3", "1E-3", "007"})
    EXPECT_TRUE(parse_number(good)) << good;
  for (std::string_view bad : {"", "-", "+", "nan", "inf", "-inf", ".nan", "1e999", "0x10", " 1",
                               "1 ", "1,5", "1 µm", "--1", "+-1", "e5", ".", "1e"})
    EXPECT_FALSE(parse_number(bad)) << bad;
}

// The recursive definition, beside the rows of the real one.
std::size_t slow_distance(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  const auto cut = [](std::string_view s, std::size_t n) { return s.substr(0, s.size() - n); };
  std::size_t best =
      std::min({slow_distance(cut(a, 1), b) + 1, slow_distance(a, cut(b, 1)) + 1,
                slow_distance(cut(a, 1), cut(b, 1)) + (a.back() != b.back() ? 1 : 0)});
  if (a.size() > 1 && b.size() > 1 && a.back() == b[b.size() - 2] && b.back() == a[a.size() - 2])
    best = std::min(best, slow_distance(cut(a, 2), cut(b, 2)) + 1);
  return best;
}

TEST(Text, QuotesAreShortAndOfOneLine) {
  EXPECT_EQ(quote("fast"), "'fast'");
  EXPECT_EQ(quote("a\nb\x7f"), "'a?b?'");
  EXPECT_EQ(quote(std::string(41, 'a')), "'" + std::string(40, 'a') + "…'");
  EXPECT_EQ(quote(std::string(39, 'a') + "µµ"), "'" + std::string(39, 'a') + "…'");
}

TEST(Text, EditDistanceMatchesItsDefinition) {
  EXPECT_EQ(edit_distance("stpe", "step"), 1u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  Rng rng(2, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    std::string a, b;
    for (std::uint64_t n = rng.below(6); n > 0; --n) a += static_cast<char>('a' + rng.below(3));
    for (std::uint64_t n = rng.below(6); n > 0; --n) b += static_cast<char>('a' + rng.below(3));
    EXPECT_EQ(edit_distance(a, b), slow_distance(a, b)) << a << " " << b;
  }
}

TEST(Text, NearestWordIsNearOrNone) {
  const std::string_view keys[] = {"step_um", "stop_um", "max_nodes"};
  EXPECT_EQ(nearest_word("stpe_um", keys), "step_um");
  EXPECT_EQ(nearest_word("max_node", keys), "max_nodes");
  EXPECT_EQ(nearest_word("clearance_um", keys), "");
  EXPECT_EQ(nearest_word("", keys), "");
  EXPECT_EQ(nearest_word(std::string(1'000'000, 'a'), keys), "");
}

TEST(Text, TablesOfOtherLanguagesAreRead) {
  using Cells = std::vector<std::string_view>;
  EXPECT_EQ(csv_separator("a,b"), ',');
  EXPECT_EQ(csv_separator("a;b"), ';');
  EXPECT_EQ(csv_separator("a\tb"), '\t');
  EXPECT_EQ(csv_separator("a"), ',');
  EXPECT_EQ(csv_separator("a;b,c"), ',');
  EXPECT_EQ(csv_cells(R"("a"; "b c" ;;"")", ';'), (Cells{"a", "b c", "", ""}));
  EXPECT_EQ(csv_cells(R"("a, b",c, "d ""e, f""" ,"g)", ','),
            (Cells{"a, b", "c", R"(d ""e, f"")", "\"g"}));
  EXPECT_EQ(csv_number("0,5", ';'), "0.5");
  EXPECT_EQ(csv_number("0,5", '\t'), "0.5");
  EXPECT_EQ(csv_number("1,000,000", ';'), "1,000,000");
  EXPECT_EQ(csv_number("1,000.5", ';'), "1,000.5");
  EXPECT_EQ(csv_number("0,5", ','), "0,5");
}

TEST(Text, ACommaThatMayMeanThousandsIsRefused) {
  const auto complaint = [](std::string_view table, char separator) {
    try {
      require_clear_commas(table, "x.csv", separator);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(complaint("x;y\n0.5;2\n1,010;-3\n", ';'),
            "x.csv:3: '1,010' may be 1010 or 1.01: write thousands without a comma, and decimals "
            "in one way");
  for (const auto& [table, separator] : {std::pair("x\ty\n995.5\t2\n-1,010\t3\n", '\t'),
                                         {"x\ty\n995\t2\n1,010\t3\n", '\t'},
                                         {"\"1,500\",200,30,10\n", ','},
                                         {"\"1,500\";0.5\n", ';'}})
    EXPECT_NE(complaint(table, separator).find("may be"), std::string::npos) << table;
  for (const auto& [table, separator] : {std::pair("x;y\n0,5;2\n1,010;3\n", ';'),
                                         {"x;y\n1,010;3\n", ';'},
                                         {"1,010\t2,345\n", '\t'},
                                         {"0,125\t2,345\n7\t8\n", '\t'},
                                         {"\"1,5\",\"2,125\"\n", ','},
                                         {"1,010,2.5\n", ','},
                                         {"0,5;1.5\n", ';'},
                                         {"# 1,010;1.5\n1,010;2\n", ';'},
                                         {"\"a,b\",1.5\n", ','},
                                         {"1234,567;1.5\n", ';'}})
    EXPECT_EQ(complaint(table, separator), "") << table;
}

TEST(Text, AValueThatIsNoneOfTheWordsIsAnsweredWithTheNearestAndAll) {
  const std::vector<std::string_view> words{"rrt", "rrt_star", "drrt_star", "disc"};
  const std::string all = "rrt, rrt_star, drrt_star, disc";
  EXPECT_EQ(allowed_words("disk", words), "did you mean 'disc'? Allowed: " + all);
  EXPECT_EQ(allowed_words("rtt_star", words), "did you mean 'rrt_star'? Allowed: " + all);
  EXPECT_EQ(allowed_words("drtt", words), "did you mean 'drrt_star'? Allowed: " + all);
  EXPECT_EQ(allowed_words("spline", words), "allowed: " + all);
  EXPECT_EQ(allowed_words("", words), "allowed: " + all);
  EXPECT_EQ(allowed_words("x", {}), "allowed: ");
}

}  // namespace
}  // namespace microswarm
