// A table whose rows are constants in files of their own. It holds references, so that a row found in the table is the constant
// itself and rows can be compared by address.
#pragma once

#include <compare>
#include <cstddef>
#include <iterator>
#include <span>

namespace hooke {

// Read as a list: `for (const Row& row : table)`, `table[i]`, `table.size()`. A std::views::transform would be simpler, but clang 14, which
// is used by the fuzzers and scripts/tidy, cannot compile the one of GCC 12.
template <class Row>
class Table {
 public:
  class Iterator {
   public:
    using value_type = Row;
    using difference_type = std::ptrdiff_t;
    using reference = const Row&;
    using pointer = const Row*;
    using iterator_category = std::random_access_iterator_tag;

    Iterator() = default;
    explicit Iterator(const Row* const* place) : place_(place) {}
    const Row& operator*() const { return **place_; }
    const Row* operator->() const { return *place_; }
    const Row& operator[](std::ptrdiff_t n) const { return *place_[n]; }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this += -1; }
    Iterator operator++(int) { return Iterator(place_++); }
    Iterator operator--(int) { return Iterator(place_--); }
    Iterator& operator+=(std::ptrdiff_t n) {
      place_ += n;
      return *this;
    }
    Iterator& operator-=(std::ptrdiff_t n) { return *this += -n; }
    friend Iterator operator+(Iterator it, std::ptrdiff_t n) { return it += n; }
    friend Iterator operator+(std::ptrdiff_t n, Iterator it) { return it += n; }
    friend Iterator operator-(Iterator it, std::ptrdiff_t n) { return it -= n; }
    friend std::ptrdiff_t operator-(Iterator a, Iterator b) { return a.place_ - b.place_; }
    friend auto operator<=>(Iterator a, Iterator b) = default;

   private:
    const Row* const* place_ = nullptr;
  };

  explicit Table(std::span<const Row* const> rows) : rows_(rows) {}
  Iterator begin() const { return Iterator(rows_.data()); }
  Iterator end() const { return begin() + std::ssize(rows_); }
  std::size_t size() const { return rows_.size(); }
  bool empty() const { return rows_.empty(); }
  const Row& operator[](std::size_t i) const { return *rows_[i]; }
  const Row& front() const { return *rows_.front(); }
  const Row& back() const { return *rows_.back(); }

 private:
  std::span<const Row* const> rows_;
};

}  // namespace hooke
