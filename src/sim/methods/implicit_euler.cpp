// x' = x + h v',  v' = v + h a(x', v')     (backward Euler)
// First order, L-stable. Solved to convergence, unlike baraff_witkin; damps all motion, fast motion more strongly.
#include "sim/methods/implicit/dirk.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

constexpr DirkTable table{.stages = 1, .a = {{{1.0}}}, .b = {1.0}, .b_embedded = no_embedded, .tolerance = 1e-8};

}  // namespace

constinit const Integrator implicit_euler{
    .id = "implicit_euler",
    .label = "Implicit Euler",
    .summary =
        "Implicit Euler solved to convergence, for comparison: no limit on the step for small vibrations, strongly damped, first order.",
    .cost = "a nonlinear solve per step: two to five factorizations where springs are stiff",
    .formula =
        "v' = v + h a(x', v')\n"
        "x' = x + h v'",
    .source =
        "E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.3; solved as in T. F. Gast, C. Schroeder, Optimization "
        "Integrator for Large Time Steps, SCA 2014",
    .order = 1,
    .order_with = {.drag = 1, .damped = 1, .contact = 1, .force_terms = 1},
    .stability = Stability::LStable,
    .energy = EnergyTrend::Falls,
    .implicit_solve = ImplicitSolve::Iterative,
    .velocity_lag = 0.5,
    .prepare = DirkMethod<table>::prepare,
    .step = DirkMethod<table>::step,
    .amplification = DirkMethod<table>::amplification,
};

}  // namespace hooke
