// y = (x, v) of the free points, six numbers each, and
//   x' = v,  v' = g - sum F u / m,  F = k (l - l0) + d w,  l = |x - x2|,  u = (x - x2) / l,  w = u . (v - v2)
// over the springs at each point; x2, v2 are those of the other end. With P = (I - u u^T) / l
//   d(F u)/dx = k u u^T + F P + d u (P (v - v2))^T,  d(F u)/dv = d u u^T.
#include "study/oracle.h"

#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <sundials/sundials_context.hpp>
#include <type_traits>

namespace hooke {
namespace {

constexpr int nail = -1;

struct Tie {
  int first, second;  // points
  double k, d, l0;
};

// The scene and the positions of all points, including nails, while derivatives are computed.
struct Network {
  Vec3 gravity;
  std::vector<double> mass;
  std::vector<int> slot;  // index of each point in y; or nail
  std::vector<Tie> ties;
  std::vector<Vec3> x, v, force;
  sunindextype size = 0;                        // of y
  std::vector<sunindextype> column_begin, row;  // the pattern of the matrix of derivatives, column by column

  Network(const System& system, const State& start) : gravity(system.gravity), x(start.position), v(start.velocity), force(x.size()) {
    if (system.drag_rate() != 0.0 || system.grab || !system.forces.empty() || !system.colliders.empty() || system.dimensions != 3)
      throw std::invalid_argument("the oracle supports only points, springs and gravity");
    for (const Point& point : system.points()) {
      mass.push_back(point.mass);
      slot.push_back(point.nailed ? nail : static_cast<int>(size));
      if (!point.nailed) size += 6;
      if (point.nailed) v[slot.size() - 1] = Vec3(0.0);
    }
    for (const Spring& spring : system.springs())
      ties.push_back({system.index_of(spring.first), system.index_of(spring.second), spring.stiffness, spring.damping, spring.rest_length});
    lay_out_columns();
  }

  void unpack(const double* y) {
    for (std::size_t i = 0; i < slot.size(); ++i) {
      if (slot[i] == nail) continue;
      x[i] = {y[slot[i]], y[slot[i] + 1], y[slot[i] + 2]};
      v[i] = {y[slot[i] + 3], y[slot[i] + 4], y[slot[i] + 5]};
    }
  }

  void pack(double* y) const {
    for (std::size_t i = 0; i < slot.size(); ++i)
      for (int c = 0; c < 3 && slot[i] != nail; ++c) {
        y[slot[i] + c] = x[i][c];
        y[slot[i] + 3 + c] = v[i][c];
      }
  }

 private:
  // A velocity affects its own position, and both affect the velocities of the same point and its neighbors. The diagonal element of a
  // position is zero, but it is needed for I - h J.
  void lay_out_columns() {
    std::vector<std::set<int>> near(slot.size());
    for (const Tie& tie : ties)
      for (const int point : {tie.first, tie.second})
        for (const int other : {tie.first, tie.second})
          if (slot[other] != nail) near[point].insert(slot[other]);
    for (std::size_t i = 0; i < slot.size(); ++i)
      for (int c = 0; c < 6 && slot[i] != nail; ++c) {
        column_begin.push_back(static_cast<sunindextype>(row.size()));
        row.push_back(slot[i] + c % 3);
        for (const int other : near[i])
          for (int r = 3; r < 6; ++r) row.push_back(other + r);
        std::sort(row.begin() + column_begin.back(), row.end());
      }
    column_begin.push_back(static_cast<sunindextype>(row.size()));
  }
};

// One spring in its current state.
struct Pull {
  Vec3 u, w_across;  // unit vector; P (v - v2) [1/s]
  double length, tension;

  Pull(const Network& network, const Tie& tie) {
    const Vec3 apart = network.x[tie.first] - network.x[tie.second], v = network.v[tie.first] - network.v[tie.second];
    length = glm::length(apart);
    u = apart / length;
    const double w = glm::dot(u, v);
    w_across = (v - w * u) / length;
    tension = tie.k * (length - tie.l0) + tie.d * w;
  }
};

int compute_slopes(double, N_Vector y, N_Vector slope, void* user) {
  auto& network = *static_cast<Network*>(user);
  network.unpack(N_VGetArrayPointer(y));
  for (std::size_t i = 0; i < network.force.size(); ++i) network.force[i] = network.mass[i] * network.gravity;
  for (const Tie& tie : network.ties) {
    const Pull pull(network, tie);
    network.force[tie.first] -= pull.tension * pull.u;
    network.force[tie.second] += pull.tension * pull.u;
  }

  double* to = N_VGetArrayPointer(slope);
  for (std::size_t i = 0; i < network.slot.size(); ++i)
    for (int c = 0; c < 3 && network.slot[i] != nail; ++c) {
      to[network.slot[i] + c] = network.v[i][c];
      to[network.slot[i] + 3 + c] = network.force[i][c] / network.mass[i];
    }
  return 0;
}

void add(SUNMatrix matrix, int row, int column, double value) {
  const sunindextype* begin = SUNSparseMatrix_IndexPointers(matrix);
  const sunindextype* rows = SUNSparseMatrix_IndexValues(matrix);
  const auto at = std::lower_bound(rows + begin[column], rows + begin[column + 1], row) - rows;
  SUNSparseMatrix_Data(matrix)[at] += value;
}

int compute_derivatives(double, N_Vector y, N_Vector, SUNMatrix matrix, void* user, N_Vector, N_Vector, N_Vector) {
  auto& network = *static_cast<Network*>(user);
  network.unpack(N_VGetArrayPointer(y));
  // the solver has cleared it, including its pattern
  std::copy(network.column_begin.begin(), network.column_begin.end(), SUNSparseMatrix_IndexPointers(matrix));
  std::copy(network.row.begin(), network.row.end(), SUNSparseMatrix_IndexValues(matrix));
  std::fill_n(SUNSparseMatrix_Data(matrix), network.row.size(), 0.0);

  for (const int slot : network.slot)
    for (int c = 0; c < 3 && slot != nail; ++c) add(matrix, slot + c, slot + 3 + c, 1.0);
  for (const Tie& tie : network.ties) {
    const Pull pull(network, tie);
    for (const int of : {tie.first, tie.second})
      for (const int by : {tie.first, tie.second}) {
        const int row = network.slot[of], column = network.slot[by];
        if (row == nail || column == nail) continue;
        const double scale = (of == by ? -1.0 : 1.0) / network.mass[of];
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            const double along = pull.u[r] * pull.u[c], across = ((r == c ? 1.0 : 0.0) - along) / pull.length;
            add(matrix, row + 3 + r, column + c, scale * (tie.k * along + pull.tension * across + tie.d * pull.u[r] * pull.w_across[c]));
            add(matrix, row + 3 + r, column + 3 + c, scale * tie.d * along);
          }
      }
  }
  return 0;
}

// SUNDIALS objects are freed in the opposite order of their creation.
template <auto free>
struct Freed {
  template <class Handle>
  void operator()(Handle* handle) const {
    free(handle);
  }
};
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, Freed<N_VDestroy>>;
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, Freed<SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, Freed<SUNLinSolFree>>;
using NonlinearSolver = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, Freed<SUNNonlinSolFree>>;
using Cvode = std::unique_ptr<void, Freed<[](void* memory) { CVodeFree(&memory); }>>;
using Arkode = std::unique_ptr<void, Freed<[](void* memory) { ARKStepFree(&memory); }>>;

void check(int flag, const char* call) {
  if (flag < 0) throw std::runtime_error(std::string(call) + " of SUNDIALS failed with " + std::to_string(flag));
}

constexpr long max_steps = 1'000'000;

// Newton's method and a direct solver for the equations of an implicit step.
struct Newton {
  Matrix matrix;
  LinearSolver solver;
  Newton(const Network& network, N_Vector y, SUNContext context)
      : matrix(SUNSparseMatrix(network.size, network.size, static_cast<sunindextype>(network.row.size()), CSC_MAT, context)),
        solver(SUNLinSol_KLU(y, matrix.get(), context)) {}
};

void run_bdf(Network& network, N_Vector y, double seconds, double tolerance, SUNContext context) {
  const Cvode cvode(CVodeCreate(CV_BDF, context));
  check(CVodeInit(cvode.get(), compute_slopes, 0.0, y), "CVodeInit");
  check(CVodeSetUserData(cvode.get(), &network), "CVodeSetUserData");
  check(CVodeSStolerances(cvode.get(), 0.0, tolerance), "CVodeSStolerances");

  // without dashpots, fixed-point iteration is sufficient for every step length that occurs
  const bool is_stiff = std::any_of(network.ties.begin(), network.ties.end(), [](const Tie& tie) { return tie.d > 0.0; });
  std::optional<Newton> newton;
  NonlinearSolver substitution;
  if (is_stiff) {
    newton.emplace(network, y, context);
    check(CVodeSetLinearSolver(cvode.get(), newton->solver.get(), newton->matrix.get()), "CVodeSetLinearSolver");
    check(CVodeSetJacFn(cvode.get(), compute_derivatives), "CVodeSetJacFn");
  } else {
    constexpr int remembered = 3;  // iterations used by Anderson acceleration
    substitution.reset(SUNNonlinSol_FixedPoint(y, remembered, context));
    check(CVodeSetNonlinearSolver(cvode.get(), substitution.get()), "CVodeSetNonlinearSolver");
  }

  check(CVodeSetMaxNumSteps(cvode.get(), max_steps), "CVodeSetMaxNumSteps");
  check(CVodeSetStopTime(cvode.get(), seconds), "CVodeSetStopTime");
  double reached = 0.0;
  check(CVode(cvode.get(), seconds, y, &reached, CV_NORMAL), "CVode");
}

void run_runge_kutta(bool is_implicit, Network& network, N_Vector y, double seconds, double tolerance, SUNContext context) {
  const Arkode arkode(ARKStepCreate(is_implicit ? nullptr : compute_slopes, is_implicit ? compute_slopes : nullptr, 0.0, y, context));
  check(ARKStepSetUserData(arkode.get(), &network), "ARKStepSetUserData");
  check(ARKStepSStolerances(arkode.get(), 0.0, tolerance), "ARKStepSStolerances");
  check(is_implicit ? ARKStepSetTableNum(arkode.get(), ARKODE_KVAERNO_7_4_5, ARKODE_ERK_NONE)
                    : ARKStepSetTableNum(arkode.get(), ARKODE_DIRK_NONE, ARKODE_FEHLBERG_13_7_8),
        "ARKStepSetTableNum");
  std::optional<Newton> newton;
  if (is_implicit) {
    newton.emplace(network, y, context);
    check(ARKStepSetLinearSolver(arkode.get(), newton->solver.get(), newton->matrix.get()), "ARKStepSetLinearSolver");
    check(ARKStepSetJacFn(arkode.get(), compute_derivatives), "ARKStepSetJacFn");
  }
  check(ARKStepSetMaxNumSteps(arkode.get(), max_steps), "ARKStepSetMaxNumSteps");
  check(ARKStepSetStopTime(arkode.get(), seconds), "ARKStepSetStopTime");
  double reached = 0.0;
  check(ARKStepEvolve(arkode.get(), seconds, y, &reached, ARK_NORMAL), "ARKStepEvolve");
}

}  // namespace

State ask_oracle(Oracle oracle, const System& system, const State& start, double seconds, double tolerance) {
  Network network(system, start);
  const sundials::Context context;
  const Vector y(N_VNew_Serial(network.size, context));
  network.pack(N_VGetArrayPointer(y.get()));

  if (oracle == Oracle::Bdf)
    run_bdf(network, y.get(), seconds, tolerance, context);
  else
    run_runge_kutta(oracle == Oracle::Implicit, network, y.get(), seconds, tolerance, context);

  network.unpack(N_VGetArrayPointer(y.get()));
  State end = start;
  end.time += seconds;
  end.position = network.x;
  end.velocity = network.v;
  return end;
}

}  // namespace hooke
