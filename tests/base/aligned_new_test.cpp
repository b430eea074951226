// The programs' operator new: long blocks start at a cache line, and requests that cannot be met are refused.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace hooke {
namespace {

TEST(AlignedNew, LongBlocksStartAtACacheLine) {
  std::vector<std::vector<double>> fields;
  for (std::size_t size = 64; size < 200'000; size += size / 3 + 1) {
    fields.emplace_back(size, 1.0);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(fields.back().data()) % 64, 0u) << size;
  }
}

TEST(AlignedNew, RefusesWhatCannotBeAllocated) {
  for (const std::size_t size : {SIZE_MAX, SIZE_MAX - 63, static_cast<std::size_t>(PTRDIFF_MAX)}) {
    volatile std::size_t hidden = size;
    EXPECT_THROW(::operator delete(::operator new(hidden)), std::bad_alloc);
  }
  void* empty = ::operator new(0);
  EXPECT_NE(empty, nullptr);
  ::operator delete(empty);
}

}  // namespace
}  // namespace hooke
