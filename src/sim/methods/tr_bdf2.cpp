// The trapezoidal rule to t + gamma h, then the second backward difference to t + h     (R. E. Bank et al., Transient simulation of silicon
// devices and circuits, 1985; M. E. Hosea, L. F. Shampine, Analysis and implementation of TR-BDF2, Appl. Numer. Math. 20 (1996) 21-37),
// gamma = 2 - sqrt(2), which makes both matrices the same. Second order, L-stable, stiffly accurate, with an embedded method of third order
// for the error.
#include <numbers>

#include "sim/methods/implicit/dirk.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

constexpr double d = 1.0 - 0.5 * std::numbers::sqrt2, w = 0.25 * std::numbers::sqrt2;

constexpr DirkTable table{
    .stages = 3,
    .a = {{{}, {d, d}, {w, w, d}}},
    .b = {w, w, d},
    .b_embedded = {(1.0 - w) / 3.0, (3.0 * w + 1.0) / 3.0, d / 3.0},
    .tolerance = 1e-10,
};

}  // namespace

constinit const Integrator tr_bdf2{
    .id = "tr_bdf2",
    .label = "TR-BDF2",
    .summary = "The standard choice for very stiff or strongly damped scenes: second order, damps modes too fast for the step.",
    .cost = "two nonlinear solves per step with one matrix: one to three factorizations",
    .formula =
        "y1 = y + gamma h/2 (f(y) + f(y1)),   gamma = 2 - sqrt(2),   y = (x, v)\n"
        "y' = (y1 / gamma - (1 - gamma)^2 / gamma y + (1 - gamma) h f(y')) / (2 - gamma)",
    .source =
        "R. E. Bank et al., IEEE Trans. Electron Devices 32 (1985) 1992-2007; M. E. Hosea, L. F. Shampine, Appl. Numer. Math. 20 (1996) "
        "21-37",
    .order = 2,
    .order_with = {.drag = 2, .damped = 2, .contact = 2, .force_terms = 2},
    .stability = Stability::LStable,
    .energy = EnergyTrend::Falls,
    .implicit_solve = ImplicitSolve::Iterative,
    .prepare = DirkMethod<table>::prepare,
    .step = DirkMethod<table>::step,
    .amplification = DirkMethod<table>::amplification,
};

}  // namespace hooke
