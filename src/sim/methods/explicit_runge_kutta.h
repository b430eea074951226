// Explicit Runge-Kutta methods for y = (x, v), whose slope is (v, a), from their tables A and b. Since the slopes of x are velocities of
// the stages, sums of accelerations replace them    (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd
// ed., II.14)
//   X_i = x + h c_i v + h^2 sum_j (A A)_ij a_j,  V_i = v + h sum_j A_ij a_j,  a_i = a(t + c_i h, X_i, V_i),  c = A 1,
//   x' = x + h v + h^2 sum_j (b A)_j a_j,  v' = v + h sum_j b_j a_j.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/forces/motion.h"
#include "sim/methods/integrator.h"

namespace hooke {

template <std::size_t Stages>
using StageRow = std::array<double, Stages>;
template <std::size_t Stages>
using StageMatrix = std::array<StageRow<Stages>, Stages>;

// w A: the weights of the accelerations in x that correspond to the weights w of those in v
template <std::size_t Stages>
constexpr StageRow<Stages> times_matrix(const StageRow<Stages>& w, const StageMatrix<Stages>& a) {
  StageRow<Stages> product{};
  for (std::size_t j = 0; j < Stages; ++j) {
    long double sum = 0.0;
    for (std::size_t i = 0; i < Stages; ++i) sum += static_cast<long double>(w[i]) * a[i][j];
    product[j] = static_cast<double>(sum);
  }
  return product;
}

template <std::size_t Stages>
struct RungeKuttaTable {
  StageMatrix<Stages> a, a_squared{};
  StageRow<Stages> b, b_times_a, node{};
  constexpr RungeKuttaTable(const StageMatrix<Stages>& matrix, const StageRow<Stages>& weights)
      : a(matrix), b(weights), b_times_a(times_matrix(weights, matrix)) {
    for (std::size_t i = 0; i < Stages; ++i) {
      a_squared[i] = times_matrix(a[i], a);
      for (std::size_t j = 0; j < i; ++j) node[i] += a[i][j];
    }
  }
};

// A sum of fields and of weighted slopes, in this order.
template <std::size_t Stages>
struct StageTerms {
  std::array<ScaledField, Stages + 1> items;
  std::size_t count = 0;
  void add(double scale, const Field& field) { items[count++] = {scale, field.data()}; }
  void add_slopes(double scale, const StageRow<Stages>& w, std::span<const Field* const, Stages> slopes) {
    for (std::size_t j = 0; j < Stages; ++j)
      if (w[j] != 0.0) add(scale * w[j], *slopes[j]);
  }
  std::span<const ScaledField> all() const { return {items.data(), count}; }
  // Of the next `size` elements of the fields.
  void skip(std::size_t size) {
    for (ScaledField& item : std::span(items.data(), count)) item.x += size;
  }
};

// One step of h [s] from (motion.x, motion.v). The first slope is motion.a; the others, and two fields for the current stage, are in the
// workspace.
template <std::size_t Stages>
class RungeKuttaStep {
 public:
  static constexpr std::size_t block = 256;  // elements of a field: sums that read the same slopes find them in the cache
  using Terms = StageTerms<Stages>;

  static void prepare(const Motion& motion, Workspace& work) { work.size_fields(Stages + 1, motion); }

  RungeKuttaStep(const RungeKuttaTable<Stages>& table, const Plan& plan, Motion& motion, Workspace& work, double h)
      : table_(table), plan_(plan), motion_(motion), x_(work.fields[0]), v_(work.fields[1]), h_(h) {
    slopes_[0] = &motion.a;
    for (std::size_t i = 1; i < Stages; ++i) slopes_[i] = &work.fields[i + 1];
  }

  // All stages; the first one only if it is not known.
  void compute_slopes() {
    if (!motion_.acceleration_is_current) compute_slope(0.0, motion_.x, motion_.v, motion_.a);
    motion_.acceleration_is_current = true;
    const bool needs_velocity = plan_.drag != 0.0 || plan_.has_dashpots() || plan_.force_data.depend_on_velocity;
    for (std::size_t i = 1; i < Stages; ++i) {
      Terms of_x = position_terms(table_.node[i], table_.a_squared[i]), of_v;
      if (needs_velocity) of_v.add_slopes(h_, table_.a[i], slopes());
      set_sums(of_x, of_v, x_, needs_velocity ? &v_ : nullptr);
      compute_slope(h_ * table_.node[i], x_, needs_velocity ? v_ : motion_.v, *slopes_[i]);
    }
  }

  void finish() {
    Terms of_x = position_terms(1.0, table_.b_times_a), of_v;
    of_v.add_slopes(h_, table_.b, slopes());
    set_sums(of_x, of_v, motion_.x, &motion_.v);
    motion_.acceleration_is_current = false;
  }

  std::span<const Field* const, Stages> slopes() const { return slopes_; }

 private:
  Terms position_terms(double node, const StageRow<Stages>& w) const {
    Terms terms;
    terms.add(h_ * node, motion_.v);
    terms.add_slopes(h_ * h_, w, slopes());
    return terms;
  }

  // x' = x + sums, and v' = v + sums if there is a field for it.
  void set_sums(Terms of_x, Terms of_v, Field& x, Field* v) const {
    for (std::size_t begin = 0; begin < x.size(); begin += block) {
      const std::size_t size = std::min(block, x.size() - begin);
      set_sum(&x[begin], &motion_.x[begin], of_x.all(), size);
      of_x.skip(size);
      if (v == nullptr) continue;
      set_sum(&(*v)[begin], &motion_.v[begin], of_v.all(), size);
      of_v.skip(size);
    }
  }

  void compute_slope(double time, const Field& x, const Field& v, Field& slope) {
    compute_accelerations(plan_, motion_.time + time, x, v, slope);
    ++motion_.counts.force_evaluations;
  }

  const RungeKuttaTable<Stages>& table_;
  const Plan& plan_;
  Motion& motion_;
  Field &x_, &v_;
  double h_;
  std::array<Field*, Stages> slopes_;
};

}  // namespace hooke
