// ARK4(3)6L[2]SA, its implicit part     (C. A. Kennedy, M. H. Carpenter, Additive Runge-Kutta schemes for
// convection-diffusion-reaction equations, Appl. Numer. Math. 44 (2003) 139-181)
// Fourth order in six stages, the first explicit, gamma = 1/4; L-stable, stiffly accurate, with an embedded method of third
// order for the error.
#include "sim/methods/implicit/dirk.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

constexpr DirkTable table{
    .stages = 6,
    .a = {{{},
           {1.0 / 4.0, 1.0 / 4.0},
           {8611.0 / 62500.0, -1743.0 / 31250.0, 1.0 / 4.0},
           {5012029.0 / 34652500.0, -654441.0 / 2922500.0, 174375.0 / 388108.0, 1.0 / 4.0},
           {15267082809.0 / 155376265600.0, -71443401.0 / 120774400.0, 730878875.0 / 902184768.0, 2285395.0 / 8070912.0, 1.0 / 4.0},
           {82889.0 / 524892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102672.0, -2260.0 / 8211.0, 1.0 / 4.0}}},
    .b = {82889.0 / 524892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102672.0, -2260.0 / 8211.0, 1.0 / 4.0},
    .b_embedded = {4586570599.0 / 29645900160.0, 0.0, 178811875.0 / 945068544.0, 814220225.0 / 1159782912.0, -3700637.0 / 11593932.0,
                   61727.0 / 225920.0},
    .tolerance = 1e-13,
};

}  // namespace

constinit const Integrator esdirk4{
    .id = "esdirk4",
    .label = "ESDIRK4(3)",
    .summary = "Small errors in very stiff or strongly damped scenes: fourth order, damps modes too fast for the step.",
    .cost = "five nonlinear solves per step with one matrix: one to three factorizations",
    .formula =
        "y_i = y + h sum_{j <= i} A_ij f(y_j),   i = 1 ... 6,   A_11 = 0, A_ii = 1/4\n"
        "y' = y_6",
    .source = "C. A. Kennedy, M. H. Carpenter, Appl. Numer. Math. 44 (2003) 139-181, ARK4(3)6L[2]SA, implicit part",
    .order = 4,
    .order_with = {.drag = 4, .damped = 4, .contact = 2, .force_terms = 4},
    .stability = Stability::LStable,
    .energy = EnergyTrend::Falls,
    .implicit_solve = ImplicitSolve::Iterative,
    .prepare = DirkMethod<table>::prepare,
    .step = DirkMethod<table>::step,
    .amplification = DirkMethod<table>::amplification,
};

}  // namespace hooke
