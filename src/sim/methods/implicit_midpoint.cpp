// V = v + h/2 a(x + h/2 V, V),  x' = x + h V,  v' = 2 V - v     (Gauss, one stage)
// Second order, symplectic, A-stable but not L-stable: linear modes neither grow nor decay. Conserves linear and angular momentum, and
// energy up to the error due to springs that rotate within a step.
#include "sim/methods/implicit/dirk.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

constexpr DirkTable table{.stages = 1, .a = {{{0.5}}}, .b = {1.0}, .b_embedded = no_embedded, .tolerance = 1e-12};

}  // namespace

constinit const Integrator implicit_midpoint{
    .id = "implicit_midpoint",
    .label = "Implicit midpoint",
    .summary = "Conserves the energy of smooth motion at steps beyond the explicit limit; fails for stiff springs that rotate.",
    .cost = "a nonlinear solve per step",
    .formula =
        "V = v + h/2 a(x + h/2 V, V)\n"
        "x' = x + h V,   v' = 2 V - v",
    .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, II.1 (Gauss, one stage)",
    .order = 2,
    .order_with = {.drag = 2, .damped = 2, .contact = 2, .force_terms = 2},
    .stability = Stability::AStable,
    .energy = EnergyTrend::Bounded,
    .implicit_solve = ImplicitSolve::Iterative,
    .for_production = false,
    .prepare = DirkMethod<table>::prepare,
    .step = DirkMethod<table>::step,
    .amplification = DirkMethod<table>::amplification,
};

}  // namespace hooke
