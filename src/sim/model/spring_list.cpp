#include "sim/model/spring_list.h"

#include <algorithm>

namespace hooke {

SpringList::SpringList(const std::vector<Spring>& springs) {
  reserve(springs.size());
  for (const Spring& spring : springs) push_back(spring);
}

void SpringList::reserve(std::size_t capacity) {
  if (!ids_.empty()) ids_.reserve(capacity);
  ends_.reserve(capacity);
  families_.reserve(capacity);
  for (NumberList* numbers : {&stiffness_, &damping_, &rest_length_, &break_strain_}) numbers->reserve(capacity);
}

void SpringList::push_back(const Spring& spring) {
  const std::size_t count = size();
  if (ids_.empty() && static_cast<std::size_t>(spring.id) != count) {
    ids_.reserve(ends_.capacity());
    for (std::size_t s = 0; s < count; ++s) ids_.push_back(SpringId{static_cast<std::uint32_t>(s)});
  }
  if (!ids_.empty() || static_cast<std::size_t>(spring.id) != count) ids_.push_back(spring.id);
  ends_.push_back({spring.first, spring.second});
  families_.push_back(spring.family);
  stiffness_.push_back(spring.stiffness);
  damping_.push_back(spring.damping);
  rest_length_.push_back(spring.rest_length);
  break_strain_.push_back(spring.break_strain);
  if (spring.law) laws_.resize(size());
  if (!laws_.empty()) laws_.resize(size()), laws_.back() = spring.law;
}

void SpringList::set_properties(std::size_t s, const Spring& spring) {
  stiffness_.set(s, spring.stiffness);
  damping_.set(s, spring.damping);
  rest_length_.set(s, spring.rest_length);
  break_strain_.set(s, spring.break_strain);
  if (spring.law) laws_.resize(size());
  if (!laws_.empty()) laws_[s] = spring.law;
}

SpringList SpringList::select(std::span<const Index> indices) const {
  SpringList selected;
  const std::size_t count = indices.size();
  std::size_t in_place = 0;
  while (in_place < count && static_cast<std::size_t>(indices[in_place]) == in_place) ++in_place;
  if (!ids_.empty() || in_place < count) selected.ids_.reserve(count);
  selected.ends_.reserve(count);
  selected.families_.reserve(count);
  for (const Index s : indices) {
    if (!ids_.empty())
      selected.ids_.push_back(ids_[s]);
    else if (in_place < count)
      selected.ids_.push_back(SpringId{static_cast<std::uint32_t>(s)});
    selected.ends_.push_back(ends_[s]);
    selected.families_.push_back(families_[s]);
    if (!laws_.empty()) selected.laws_.push_back(laws_[s]);
  }
  selected.stiffness_ = stiffness_.select(indices);
  selected.damping_ = damping_.select(indices);
  selected.rest_length_ = rest_length_.select(indices);
  selected.break_strain_ = break_strain_.select(indices);
  return selected;
}

std::size_t SpringList::bytes() const {
  return ids_.capacity() * sizeof(SpringId) + ends_.capacity() * sizeof(ends_[0]) + families_.capacity() * sizeof(SpringFamily) +
         laws_.capacity() * sizeof(std::optional<SpringLaw>) + stiffness_.bytes() + damping_.bytes() + rest_length_.bytes() +
         break_strain_.bytes();
}

bool SpringList::operator==(const SpringList& other) const { return std::ranges::equal(*this, other); }

}  // namespace hooke
