// Tests of many cases that take long in all are divided into parts: the first is run each time, the others nightly.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>

namespace hooke {

// Instantiated twice: INSTANTIATE_TEST_SUITE_P(Daily, Suite, testing::Values(0)), and (Nightly, Suite, testing::Range(1, Suite::parts)).
template <int count>
class InParts : public testing::TestWithParam<int> {
 public:
  static constexpr int parts = count;

 protected:
  bool has(int number) const { return number % count == GetParam(); }
  // Which of `parts` variants is that of a case: each part has every case and every variant, and all parts have every combination.
  std::size_t variant_of(std::size_t number) const { return (number + static_cast<std::size_t>(GetParam())) % count; }
};

}  // namespace hooke
