#include "base/printable.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

TEST(Printable, LongMessagesLoseTheirMiddle) {
  EXPECT_EQ(without_middle("abcdef", 6), "abcdef");
  EXPECT_EQ(without_middle("abcdefg", 6), "abc...efg");
  const std::string message = std::string(100'000, 'A') + ": no such file";
  EXPECT_EQ(without_middle(message), std::string(1000, 'A') + "..." + message.substr(message.size() - 1000));
}

TEST(Printable, CharactersAreNotDivided) {
  std::string text;
  for (int i = 0; i < 30; ++i) text += "\u20ac";
  for (std::size_t max = 0; max < text.size() + 2; ++max) {
    EXPECT_TRUE(is_utf8(printable(text, max))) << max;
    EXPECT_TRUE(is_utf8(without_middle(text, max))) << max;
    EXPECT_LE(without_middle(text, max).size(), max + 3);
  }
}

}  // namespace
}  // namespace hooke
