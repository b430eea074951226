// Lists of numbers that store equal ones once.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "base/lists/number_list.h"
#include "base/same_bits.h"

namespace hooke {
namespace {

// `count` numbers, of which this many are different.
std::vector<double> numbers_of(std::size_t count, std::size_t different) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(1.0 / (1.0 + static_cast<double>(i * 7919 % different)));
  return numbers;
}

void expect_same_bits(const NumberList& list, const std::vector<double>& numbers) {
  ASSERT_EQ(list.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_TRUE(same_bits(list[i], numbers[i])) << i;
}

class NumberLists : public testing::TestWithParam<std::size_t> {};

TEST_P(NumberLists, KeepTheBitsOfEveryEntry) {
  std::vector<double> numbers = numbers_of(10'000, GetParam());
  NumberList list = numbers;
  expect_same_bits(list, numbers);
  for (const double number : {0.0, -0.0, std::numeric_limits<double>::infinity(), std::nan(""), -1.0}) {
    list.push_back(number);
    numbers.push_back(number);
  }
  expect_same_bits(list, numbers);
  EXPECT_FALSE(list == list) << "it contains a NaN";
}

TEST_P(NumberLists, KeepWhatIsSet) {
  std::vector<double> numbers = numbers_of(10'000, GetParam());
  NumberList list = numbers;
  for (std::size_t i = 0; i < numbers.size(); i += 1 + i % 3) {
    numbers[i] = static_cast<double>(i % (2 * GetParam()));
    list.set(i, numbers[i]);
  }
  expect_same_bits(list, numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) list.set(i, 5.0);
  expect_same_bits(list, std::vector<double>(numbers.size(), 5.0));
}

TEST_P(NumberLists, GrowAndShrink) {
  std::vector<double> numbers = numbers_of(6000, GetParam());
  NumberList list = numbers;
  list.resize(7000, 0.25);
  numbers.resize(7000, 0.25);
  expect_same_bits(list, numbers);
  list.resize(50, 0.0);
  numbers.resize(50);
  list.pop_back();
  numbers.pop_back();
  expect_same_bits(list, numbers);
  list.push_back(77.0);
  numbers.push_back(77.0);
  expect_same_bits(list, numbers);
}

TEST_P(NumberLists, SelectEntriesInAnyOrder) {
  std::vector<double> numbers = numbers_of(5000, GetParam()), selected;
  const NumberList list = numbers;
  std::vector<Index> indices;
  for (Index i = 0; i < 5000; i += 1 + i % 4) indices.push_back(4999 - i);
  for (const Index i : indices) selected.push_back(numbers[static_cast<std::size_t>(i)]);
  NumberList result = list.select(indices);
  expect_same_bits(result, selected);
  for (std::size_t i = 0; i < 300; ++i) {
    result.push_back(numbers[i]);
    selected.push_back(numbers[i]);
    result.set(i, -0.5);
    selected[i] = -0.5;
  }
  expect_same_bits(result, selected);
  EXPECT_TRUE(list.select({}).empty());
}

INSTANTIATE_TEST_SUITE_P(Different, NumberLists, testing::Values(1, 2, 256, 257, 4096, 4097, 10'000));

TEST(NumberList, TakesAsManyBytesAsTheDifferentNumbersNeed) {
  constexpr std::size_t count = 100'000, table = 64'000;
  const auto bytes = [](std::size_t different) { return NumberList(numbers_of(count, different)).bytes(); };
  EXPECT_LT(bytes(1), 100u);
  EXPECT_LT(bytes(200), count + table);
  EXPECT_LT(bytes(4000), 2 * count + table);
  EXPECT_EQ(bytes(50'000), 8 * count);
}

// As while a slider is dragged.
TEST(NumberList, ForgetsNumbersThatNoEntryHas) {
  NumberList list = numbers_of(1000, 2);
  for (int change = 0; change < 5000; ++change)
    for (std::size_t i = 0; i < list.size(); ++i) list.set(i, 0.5 * change);
  EXPECT_LT(list.bytes(), 6000u);
  expect_same_bits(list, std::vector<double>(1000, 2499.5));
}

// As where springs are added and deleted again.
TEST(NumberList, ForgetsNumbersThatWereNotSelected) {
  NumberList list = numbers_of(1000, 2);
  std::vector<Index> all_but_last(1000);
  std::iota(all_but_last.begin(), all_but_last.end(), 0);
  for (int change = 0; change < 5000; ++change) {
    list.push_back(0.5 * change);
    list = list.select(all_but_last);
  }
  EXPECT_LT(list.bytes(), 6000u);
  expect_same_bits(list, numbers_of(1000, 2));
}

TEST(NumberList, IsEmptyAfterItWasMovedFrom) {
  NumberList one = numbers_of(100, 30);
  const NumberList two = std::move(one);
  expect_same_bits(two, numbers_of(100, 30));
  expect_same_bits(one, {});  // NOLINT(bugprone-use-after-move): what is left is specified
  one.push_back(0.5);
  expect_same_bits(one, {0.5});
}

TEST(NumberList, EqualsAnotherWithTheSameNumbersHoweverTheyAreStored) {
  NumberList one = numbers_of(100, 3), two = numbers_of(100, 100);
  EXPECT_FALSE(one == two);
  for (std::size_t i = 0; i < 100; ++i) two.set(i, one[i]);
  EXPECT_TRUE(one == two);
}

}  // namespace
}  // namespace hooke
