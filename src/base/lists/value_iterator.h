// Iterates over a list whose elements are computed when they are read, by its operator[].
#pragma once

#include <compare>
#include <cstddef>
#include <iterator>

namespace hooke {

// Random access, to values instead of references. The list must outlive it.
template <class List>
class ValueIterator {
 public:
  using iterator_concept = std::random_access_iterator_tag;
  using iterator_category = std::input_iterator_tag;
  using value_type = typename List::value_type;
  using difference_type = std::ptrdiff_t;
  using reference = value_type;
  // What `->` returns: the value itself, for the duration of the expression.
  struct Pointer {
    value_type value;
    const value_type* operator->() const { return &value; }
  };
  using pointer = Pointer;

  ValueIterator() = default;
  ValueIterator(const List& list, std::size_t at) : list_(&list), at_(static_cast<difference_type>(at)) {}

  value_type operator*() const { return (*list_)[static_cast<std::size_t>(at_)]; }
  pointer operator->() const { return {**this}; }
  value_type operator[](difference_type n) const { return *(*this + n); }

  ValueIterator& operator+=(difference_type n) { return at_ += n, *this; }
  ValueIterator& operator-=(difference_type n) { return at_ -= n, *this; }
  ValueIterator& operator++() { return *this += 1; }
  ValueIterator& operator--() { return *this -= 1; }
  ValueIterator operator++(int) { return (*this += 1) - 1; }
  ValueIterator operator--(int) { return (*this -= 1) + 1; }
  friend ValueIterator operator+(ValueIterator it, difference_type n) { return it += n; }
  friend ValueIterator operator+(difference_type n, ValueIterator it) { return it += n; }
  friend ValueIterator operator-(ValueIterator it, difference_type n) { return it -= n; }
  friend difference_type operator-(const ValueIterator& a, const ValueIterator& b) { return a.at_ - b.at_; }
  bool operator==(const ValueIterator& other) const { return at_ == other.at_; }
  auto operator<=>(const ValueIterator& other) const { return at_ <=> other.at_; }

 private:
  const List* list_ = nullptr;
  difference_type at_ = 0;
};

}  // namespace hooke
