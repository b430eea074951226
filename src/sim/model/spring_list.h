// The springs of a System. A large net has millions of them, most of which have the same properties: each different number is stored once.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/lists/number_list.h"
#include "base/lists/value_list.h"
#include "base/types.h"
#include "sim/model/spring_law.h"

namespace hooke {

inline constexpr double never_breaks = std::numeric_limits<double>::infinity();

// The role of a spring in a cloth: a family is switched and tuned together.
enum class SpringFamily : std::uint8_t {
  None,
  Structural,  // along the threads
  Shear,       // across the cells
  Bend,        // to the second next point
};
inline constexpr std::size_t spring_families = 4;

struct Spring {
  SpringId id{};
  PointId first{}, second{};
  SpringFamily family = SpringFamily::None;
  double stiffness = 100.0;            // [N/m], >= 0
  double damping = 0.0;                // [N s/m], >= 0: a dashpot along the spring
  double rest_length = 1.0;            // [m], >= 0
  double break_strain = never_breaks;  // [1], > 0
  std::optional<SpringLaw> law{};      // none: linear, with a constant rest length
  bool operator==(const Spring&) const = default;
};

// Reads like a vector of springs, but returns values instead of references.
class SpringList : public ValueList<SpringList, Spring> {
 public:
  SpringList() = default;
  SpringList(const std::vector<Spring>& springs);  // implicit: wherever a plain list is at hand
  operator std::vector<Spring>() const { return {begin(), end()}; }

  std::size_t size() const { return ends_.size(); }
  Spring operator[](std::size_t s) const {
    return {.id = ids_.empty() ? SpringId{static_cast<std::uint32_t>(s)} : ids_[s],
            .first = ends_[s][0],
            .second = ends_[s][1],
            .family = families_[s],
            .stiffness = stiffness_[s],
            .damping = damping_[s],
            .rest_length = rest_length_[s],
            .break_strain = break_strain_[s],
            .law = laws_.empty() ? std::nullopt : laws_[s]};
  }

  void reserve(std::size_t capacity);
  void push_back(const Spring& spring);
  bool have_laws() const { return !laws_.empty(); }
  // Sets the properties, but neither the id nor the ends nor the family.
  void set_properties(std::size_t s, const Spring& spring);
  // The springs of these indices, in this order.
  SpringList select(std::span<const Index> indices) const;

  // [bytes], of all springs.
  std::size_t bytes() const;
  bool operator==(const SpringList& other) const;

 private:
  std::vector<SpringId> ids_;  // empty: those of the indices
  std::vector<std::array<PointId, 2>> ends_;
  std::vector<SpringFamily> families_;
  NumberList stiffness_, damping_, rest_length_, break_strain_;
  std::vector<std::optional<SpringLaw>> laws_;  // empty: no spring has one
};

// A copy of a spring whose properties are written back at the end of its life: system.spring(s)->damping = 0.1.
class SpringEdit {
 public:
  SpringEdit(SpringList& list, std::size_t s) : list_(list), s_(s), spring_(list[s]) {}
  ~SpringEdit() { list_.set_properties(s_, spring_); }
  SpringEdit(const SpringEdit&) = delete;
  SpringEdit& operator=(const SpringEdit&) = delete;
  Spring* operator->() { return &spring_; }
  Spring& operator*() { return spring_; }

 private:
  SpringList& list_;
  std::size_t s_;
  Spring spring_;
};

}  // namespace hooke
