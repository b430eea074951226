#include "base/lists/number_list.h"

#include <algorithm>
#include <bit>

#include "base/same_bits.h"

namespace hooke {
namespace {

constexpr std::size_t max_bytes = 256, max_shorts = 4096;  // different numbers; with more, looking them up would take too long

}  // namespace

NumberList::NumberList(const std::vector<double>& numbers) {
  reserve(numbers.size());
  for (const double number : numbers) push_back(number);
}

NumberList& NumberList::operator=(NumberList&& other) noexcept {
  width_ = std::exchange(other.width_, Width::None);
  last_ = std::exchange(other.last_, std::uint16_t{0});
  size_ = std::exchange(other.size_, std::size_t{0});
  capacity_ = std::exchange(other.capacity_, std::size_t{0});
  different_ = std::exchange(other.different_, {});
  bytes_ = std::exchange(other.bytes_, {});
  shorts_ = std::exchange(other.shorts_, {});
  order_ = std::exchange(other.order_, {});
  return *this;
}

std::size_t NumberList::max_different() const {
  return width_ == Width::None ? 1 : width_ == Width::Byte ? max_bytes : width_ == Width::Short ? max_shorts : different_.max_size();
}

void NumberList::reserve(std::size_t capacity) {
  capacity_ = capacity;
  if (width_ == Width::Byte) bytes_.reserve(capacity);
  if (width_ == Width::Short) shorts_.reserve(capacity);
  if (width_ == Width::Whole) different_.reserve(capacity);
}

void NumberList::resize(std::size_t size, double number) {
  while (size_ < size) push_back(number);
  size_ = size;
  if (width_ == Width::Byte) bytes_.resize(size);
  if (width_ == Width::Short) shorts_.resize(size);
  if (width_ == Width::Whole) different_.resize(size);
}

void NumberList::push_back(double number) {
  const std::optional<std::uint16_t> place = find_or_add(number);
  if (width_ == Width::Byte) bytes_.push_back(static_cast<std::uint8_t>(*place));
  if (width_ == Width::Short) shorts_.push_back(*place);
  if (width_ == Width::Whole) different_.push_back(number);
  ++size_;
}

void NumberList::pop_back() { resize(size_ - 1, 0.0); }

void NumberList::set(std::size_t i, double number) {
  if (same_bits((*this)[i], number)) return;
  if (size_ == 1) {
    *this = NumberList();
    push_back(number);
    return;
  }
  const std::optional<std::uint16_t> place = find_or_add(number);
  if (width_ == Width::Byte) bytes_[i] = static_cast<std::uint8_t>(*place);
  if (width_ == Width::Short) shorts_[i] = *place;
  if (width_ == Width::Whole) different_[i] = number;
}

NumberList NumberList::select(std::span<const Index> indices) const {
  NumberList selected;
  if (indices.empty()) return selected;
  const auto select_from = [&](const auto& entries, auto& to) {
    to.reserve(indices.size());
    for (const Index i : indices) to.push_back(entries[i]);
  };
  selected.width_ = width_;
  selected.size_ = indices.size();
  selected.order_ = order_;
  if (width_ == Width::Byte) select_from(bytes_, selected.bytes_);
  if (width_ == Width::Short) select_from(shorts_, selected.shorts_);
  if (width_ == Width::Whole)
    select_from(different_, selected.different_);
  else
    selected.different_ = different_;
  return selected;
}

// The numbers that no entry has any more, as while a slider is dragged, if they are at least half.
void NumberList::drop_unused() {
  NumberList used;
  used.reserve(std::max(capacity_, size_));
  for (const double number : *this) used.push_back(number);
  if (2 * used.different_.size() <= different_.size()) *this = std::move(used);
}

// The place in `different_`.
std::optional<std::uint16_t> NumberList::find(double number) {
  if (last_ < different_.size() && same_bits(different_[last_], number)) return last_;
  const auto bits_at = [&](std::uint16_t place) { return std::bit_cast<std::uint64_t>(different_[place]); };
  const auto bits = std::bit_cast<std::uint64_t>(number);
  const auto at = std::ranges::lower_bound(order_, bits, {}, bits_at);
  if (at == order_.end() || bits_at(*at) != bits) return std::nullopt;
  last_ = *at;
  return last_;
}

// The same; a new number is added, which may widen the entries. None if they are the numbers themselves.
std::optional<std::uint16_t> NumberList::find_or_add(double number) {
  if (width_ != Width::Whole)
    if (const auto place = find(number)) return place;
  if (width_ != Width::Whole && different_.size() == max_different()) drop_unused();
  if (width_ != Width::Whole && different_.size() == max_different()) widen();
  if (width_ == Width::Whole) return std::nullopt;
  last_ = static_cast<std::uint16_t>(different_.size());
  const auto bits_at = [&](std::uint16_t place) { return std::bit_cast<std::uint64_t>(different_[place]); };
  order_.insert(std::ranges::lower_bound(order_, std::bit_cast<std::uint64_t>(number), {}, bits_at), last_);
  different_.push_back(number);
  return last_;
}

void NumberList::widen() {
  const std::size_t capacity = std::max(capacity_, size_);
  if (width_ == Width::None) {
    bytes_.reserve(capacity);
    bytes_.assign(size_, 0);
    width_ = Width::Byte;
  } else if (width_ == Width::Byte) {
    shorts_.reserve(capacity);
    shorts_.assign(bytes_.begin(), bytes_.end());
    bytes_ = std::vector<std::uint8_t>();
    width_ = Width::Short;
  } else {
    std::vector<double> numbers;
    numbers.reserve(capacity);
    for (const std::uint16_t place : shorts_) numbers.push_back(different_[place]);
    different_ = std::move(numbers);
    shorts_ = std::vector<std::uint16_t>();
    order_ = std::vector<std::uint16_t>();
    width_ = Width::Whole;
  }
}

std::size_t NumberList::bytes() const {
  return different_.capacity() * sizeof(double) + (order_.capacity() + shorts_.capacity()) * sizeof(std::uint16_t) + bytes_.capacity();
}

bool NumberList::operator==(const NumberList& other) const { return std::ranges::equal(*this, other); }

}  // namespace hooke
