#include "sim/methods/automatic_method.h"

namespace hooke {
namespace {

constexpr Integrator automatic_row{
    .id = "auto",
    .label = "Automatic (by tolerance)",
    .summary = "Chooses the cheapest method and the substeps that keep the error within a tolerance, and says which and why.",
    .cost = "that of the chosen method, and of an estimate now and then",
    .formula = "error of a frame <= tolerance / frame rate",
    .source = "Step size control: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.2.",
    .order = 2,
    .order_with = {.drag = 2, .damped = 2, .contact = 1, .force_terms = 1},
    .stability = Stability::Adaptive,
    .energy = EnergyTrend::Drifts,
};

}  // namespace

const Integrator& automatic_method() { return automatic_row; }

}  // namespace hooke
