// A list of numbers many of which are the same, such as the stiffness of all springs: each different one is stored once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/lists/value_list.h"
#include "base/types.h"

namespace hooke {

// An entry takes no memory if all are the same, one byte if there are at most 256 different ones, two bytes if there are at most 4096, and
// otherwise eight. Numbers keep their bits.
class NumberList : public ValueList<NumberList, double> {
 public:
  NumberList() = default;
  NumberList(const std::vector<double>& numbers);  // implicit: wherever a plain list is at hand
  NumberList(const NumberList&) = default;
  NumberList& operator=(const NumberList&) = default;
  // The other one is empty then.
  NumberList(NumberList&& other) noexcept { *this = std::move(other); }
  NumberList& operator=(NumberList&& other) noexcept;
  ~NumberList() = default;

  std::size_t size() const { return size_; }
  double operator[](std::size_t i) const {
    if (width_ == Width::None) return different_[0];
    return different_[width_ == Width::Byte ? bytes_[i] : width_ == Width::Short ? shorts_[i] : i];
  }

  void reserve(std::size_t capacity);
  void resize(std::size_t size, double number);
  void push_back(double number);
  void pop_back();
  void set(std::size_t i, double number);
  // The entries of these indices, in this order.
  NumberList select(std::span<const Index> indices) const;

  // [bytes], of the entries.
  std::size_t bytes() const;
  bool operator==(const NumberList& other) const;

 private:
  enum class Width : std::uint8_t { None, Byte, Short, Whole };

  std::size_t max_different() const;
  std::optional<std::uint16_t> find(double number);
  std::optional<std::uint16_t> find_or_add(double number);
  void drop_unused();
  void widen();

  Width width_ = Width::None;
  std::uint16_t last_ = 0;  // the place that was looked up last
  std::size_t size_ = 0, capacity_ = 0;
  std::vector<double> different_;      // the different numbers; Width::Whole: the number of each entry
  std::vector<std::uint8_t> bytes_;    // Width::Byte: the place in `different_` of each entry
  std::vector<std::uint16_t> shorts_;  // Width::Short: likewise
  std::vector<std::uint16_t> order_;   // the places in `different_`, in ascending order of the bits of their numbers
};

}  // namespace hooke
