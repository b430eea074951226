#include "sim/methods/implicit/dirk.h"

#include <algorithm>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/methods/implicit/newton.h"

namespace hooke {
namespace {

// For every stage: the velocities V_i, which are the slopes of x, and the accelerations a_i; and two fields for the starting values of a
// stage.
struct Fields {
  Workspace& work;
  int stages;
  Field& velocity(int i) { return work.fields[i]; }
  Field& acceleration(int i) { return work.fields[stages + i]; }
  Field& base_x() { return work.fields[2 * stages]; }
  Field& base_v() { return work.fields[2 * stages + 1]; }
};

void copy(const Field& from, Field& to) { std::copy(from.begin(), from.end(), to.begin()); }

}  // namespace

void prepare_dirk(const DirkTable& table, const Plan& plan, const Motion& motion, Workspace& work) {
  work.size_fields(2 * table.stages + 2, motion);
  make_structure<NewtonSolver>(plan, work).begin_frame(plan, motion);
}

void step_dirk(const DirkTable& table, const Plan& plan, Motion& motion, Workspace& work, double h) {
  Fields fields{work, table.stages};
  NewtonSolver& newton = structure_of<NewtonSolver>(work);
  const std::size_t size = motion.x.size();

  for (int i = 0; i < table.stages; ++i) {
    Field &V = fields.velocity(i), &a = fields.acceleration(i);
    const double implicit = h * table.a[i][i];

    // explicit, and known if the previous step ended there
    if (implicit == 0.0) {
      if (!motion.acceleration_is_current) {
        compute_forces(plan, motion.time, motion.x, motion.v, motion.a);
        divide_by_mass(plan, motion.a);
        ++motion.counts.force_evaluations;
      }
      copy(motion.v, V);
      copy(motion.a, a);
      continue;
    }

    // x and v from the previous stages
    Field &x = fields.base_x(), &v = fields.base_v();
    copy(motion.x, x);
    copy(motion.v, v);
    for (int j = 0; j < i; ++j) {
      add_scaled(x.data(), h * table.a[i][j], fields.velocity(j).data(), size);
      add_scaled(v.data(), h * table.a[i][j], fields.acceleration(j).data(), size);
    }

    // initial guess: the velocity of the previous stage
    copy(i == 0 ? motion.v : fields.velocity(i - 1), V);
    newton.solve(plan, {motion.time + h * table.node(i), implicit, x, v}, {.tolerance = table.tolerance}, V, motion);
    set_scaled(a.data(), 1.0 / implicit, V.data(), size);
    add_scaled(a.data(), -1.0 / implicit, v.data(), size);
  }

  // the embedded method differs in the positions by this much
  if (table.b_embedded != no_embedded) {
    Field& difference = fields.base_x();
    std::fill(difference.begin(), difference.end(), 0.0);
    for (int i = 0; i < table.stages; ++i)
      add_scaled(difference.data(), h * (table.b[i] - table.b_embedded[i]), fields.velocity(i).data(), size);
    motion.local_error += root_mean_square(plan, difference);
  }

  for (int i = 0; i < table.stages; ++i) {
    add_scaled(motion.x.data(), h * table.b[i], fields.velocity(i).data(), size);
    if (!table.stiffly_accurate()) add_scaled(motion.v.data(), h * table.b[i], fields.acceleration(i).data(), size);
  }
  if (table.stiffly_accurate()) {
    copy(fields.velocity(table.stages - 1), motion.v);
    copy(fields.acceleration(table.stages - 1), motion.a);
  }
  motion.acceleration_is_current = table.stiffly_accurate();
}

std::complex<double> stability_function(const DirkTable& table, std::complex<double> z) {
  std::array<std::complex<double>, max_dirk_stages> k;
  std::complex<double> r = 1.0;
  for (int i = 0; i < table.stages; ++i) {
    std::complex<double> y = 1.0;
    for (int j = 0; j < i; ++j) y += table.a[i][j] * k[j];
    k[i] = z * y / (1.0 - z * table.a[i][i]);
    r += table.b[i] * k[i];
  }
  return r;
}

}  // namespace hooke
