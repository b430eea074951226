// What a list whose elements are computed when they are read, by its operator[], needs to be used like a vector.
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

// The base of such a List, which has a size().
template <class List, class Value>
class ValueList {
 public:
  using value_type = Value;
  using const_iterator = ValueIterator<List>;
  using iterator = const_iterator;

  bool empty() const { return list().size() == 0; }
  Value front() const { return list()[0]; }
  Value back() const { return list()[list().size() - 1]; }
  const_iterator begin() const { return {list(), 0}; }
  const_iterator end() const { return {list(), list().size()}; }
  bool operator==(const ValueList&) const = default;

 private:
  const List& list() const { return static_cast<const List&>(*this); }
};

}  // namespace hooke
