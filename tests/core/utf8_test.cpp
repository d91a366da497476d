// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/utf8.hpp"

#include <gtest/gtest.h>
#include <locale.h>

#include <cwchar>
#include <random>
#include <string>

namespace microswarm {
namespace {

/// The C library's decoder, in a locale of UTF-8, for this thread.
class CLibrary : public testing::Test {
 protected:
  void SetUp() override {
    utf8_ = ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    if (!utf8_) GTEST_SKIP() << "no locale C.UTF-8";
    before_ = ::uselocale(utf8_);
  }
  void TearDown() override {
    if (!utf8_) return;
    ::uselocale(before_);
    ::freelocale(utf8_);
  }
  static Utf8Character its_first(const std::string& text) {
    std::mbstate_t state{};
    wchar_t code = 0;
    const std::size_t n = std::mbrtowc(&code, text.data(), text.size(), &state);
    if (n > text.size() || code > 0x10ffff) return {};  // it knows characters beyond the last
    return {static_cast<std::uint32_t>(code), std::max<std::size_t>(n, 1)};
  }
  static void compare(const std::string& text) {
    const Utf8Character ours = first_character(text), theirs = its_first(text);
    ASSERT_EQ(ours.code, theirs.code) << testing::PrintToString(text);
    ASSERT_EQ(ours.bytes, theirs.bytes) << testing::PrintToString(text);
  }

 private:
  locale_t utf8_{}, before_{};
};

TEST_F(CLibrary, SaysTheSameOfAllBeginnings) {
  for (int a = 0; a < 256; ++a) {
    compare({static_cast<char>(a)});
    for (int b = 0; b < 256; ++b) {
      const std::string two{static_cast<char>(a), static_cast<char>(b)};
      compare(two);
      for (const char* rest : {"\x80", "\xbf", "a", "\x80\x80", "\xbf\xbf", "\x80z"})
        compare(two + rest);
    }
  }
}

TEST_F(CLibrary, SaysTheSameOfRandomBytes) {
  std::mt19937 random(1);
  for (int i = 0; i < 200'000; ++i) {
    std::string text(1 + random() % 5, 0);
    for (char& c : text) c = static_cast<char>(random() % 3 ? 0x80 | random() % 0x80 : random());
    compare(text);
  }
}

}  // namespace
}  // namespace microswarm
