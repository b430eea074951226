// Dormand and Prince's method of order 8 in 12 stages, with error estimates of order 5 and 3 and steps of its own     (E. Hairer,
// S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.5 and II.10: DOP853; explicit_runge_kutta.h)
// Eighth order with damping and drag too, which count as forces; stable for h omega < 5.9, h lambda < 6.3, which the
// error estimate finds by itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/forces/field_kernel.h"
#include "sim/methods/error_scale.h"
#include "sim/methods/explicit_runge_kutta.h"
#include "sim/methods/rows.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

constexpr std::size_t stages = 12;
using Row = StageRow<stages>;
using Matrix = StageMatrix<stages>;
using Step = RungeKuttaStep<stages>;

// clang-format off
constexpr Matrix a{{
    {},
    {5.26001519587677318785587544488e-2},
    {1.97250569845378994544595329183e-2, 5.91751709536136983633785987549e-2},
    {2.95875854768068491816892993775e-2, 0, 8.87627564304205475450678981324e-2},
    {2.41365134159266685502369798665e-1, 0, -8.84549479328286085344864962717e-1, 9.24834003261792003115737966543e-1},
    {3.7037037037037037037037037037e-2, 0, 0, 1.70828608729473871279604482173e-1, 1.25467687566822425016691814123e-1},
    {3.7109375e-2, 0, 0, 1.70252211019544039314978060272e-1, 6.02165389804559606850219397283e-2, -1.7578125e-2},
    {3.70920001185047927108779319836e-2, 0, 0, 1.70383925712239993810214054705e-1, 1.07262030446373284651809199168e-1, -1.53194377486244017527936158236e-2, 8.27378916381402288758473766002e-3},
    {6.24110958716075717114429577812e-1, 0, 0, -3.36089262944694129406857109825, -8.68219346841726006818189891453e-1, 2.75920996994467083049415600797e1, 2.01540675504778934086186788979e1, -4.34898841810699588477366255144e1},
    {4.77662536438264365890433908527e-1, 0, 0, -2.48811461997166764192642586468, -5.90290826836842996371446475743e-1, 2.12300514481811942347288949897e1, 1.52792336328824235832596922938e1, -3.32882109689848629194453265587e1, -2.03312017085086261358222928593e-2},
    {-9.3714243008598732571704021658e-1, 0, 0, 5.18637242884406370830023853209, 1.09143734899672957818500254654, -8.14978701074692612513997267357, -1.85200656599969598641566180701e1, 2.27394870993505042818970056734e1, 2.49360555267965238987089396762, -3.0467644718982195003823669022},
    {2.27331014751653820792359768449, 0, 0, -1.05344954667372501984066689879e1, -2.00087205822486249909675718444, -1.79589318631187989172765950534e1, 2.79488845294199600508499808837e1, -2.85899827713502369474065508674, -8.87285693353062954433549289258, 1.23605671757943030647266201528e1, 6.43392746015763530355970484046e-1},
}};
constexpr Row b{5.42937341165687622380535766363e-2, 0, 0, 0, 0, 4.45031289275240888144113950566, 1.89151789931450038304281599044, -5.8012039600105847814672114227, 3.1116436695781989440891606237e-1, -1.52160949662516078556178806805e-1, 2.01365400804030348374776537501e-1, 4.47106157277725905176885569043e-2};
// b less the weights of the companions of order 5 and 3
constexpr Row error5{0.01312004499419488073250102996, 0, 0, 0, 0, -1.225156446376204440720569753, -0.4957589496572501915214079952, 1.664377182454986536961530415, -0.3503288487499736816886487290, 0.3341791187130174790297318841, 0.08192320648511571246570742613, -0.02235530786388629525884427845};
constexpr Row error3 = [] {
  Row e = b;
  e[0] -= 0.244094488188976377952755905512;
  e[8] -= 0.733846688281611857341361741547;
  e[11] -= 0.0220588235294117647058823529412;
  return e;
}();
// clang-format on

constexpr RungeKuttaTable<stages> table(a, b);
constexpr Row error5_times_a = times_matrix(error5, a), error3_times_a = times_matrix(error3, a);

void prepare(const Plan&, double, const Motion& motion, Workspace& work) { Step::prepare(motion, work); }

// The method's estimate from those of order 5 and 3: of order 8.
double combine_errors(double error_5, double error_3) {
  return error_5 == 0.0 ? 0.0 : error_5 * error_5 / std::sqrt(error_5 * error_5 + 0.01 * error_3 * error_3);
}

struct LocalError {
  double position = 0.0, velocity = 0.0;  // [m], [m/s]
};

LocalError estimate_error(const Plan& plan, const Motion& motion, const Step& step, double h) {
  constexpr std::size_t block = Step::block;
  const std::array<std::pair<double, const Row*>, 4> estimates{
      {{h * h, &error5_times_a}, {h * h, &error3_times_a}, {h, &error5}, {h, &error3}}};
  std::array<Step::Terms, 4> terms;
  for (std::size_t e = 0; e < terms.size(); ++e) terms[e].add_slopes(estimates[e].first, *estimates[e].second, step.slopes());

  // the sums of squares of all four, in blocks that stay in the cache
  std::array<std::array<double, partial_sums>, 4> squares{};
  for (std::size_t begin = 0; begin < motion.x.size(); begin += block)
    for (std::size_t e = 0; e < terms.size(); ++e) {
      const std::size_t size = std::min(block, motion.x.size() - begin);
      add_squares_of_sum(squares[e], terms[e].all(), size);
      terms[e].skip(size);
    }
  const auto free = std::ranges::count_if(plan.inverse_mass, [](double w) { return w != 0.0; });
  const auto mean = [&](std::size_t e) {
    return free == 0 ? 0.0 : std::sqrt(std::accumulate(squares[e].begin(), squares[e].end(), 0.0) / static_cast<double>(free));
  };
  return {combine_errors(mean(0), mean(1)), combine_errors(mean(2), mean(3))};
}

// The first step, without a previous one: a radian of the fastest mode, at most the whole interval.
double first_step(const Plan& plan, double interval) {
  const double rate = std::max({plan.spectrum.omega, plan.spectrum.dashpot_rate, plan.spectrum.drag_rate});
  return rate * interval > 1.0 ? 1.0 / rate : interval;
}

// Hairer's controller (II.4 and DOP853): step *= safety error^-alpha (previous error)^beta, within bounds.
double step_factor(double error, double error_before) {
  constexpr double alpha = 1.0 / 8.0 - 0.75 * step_beta;
  if (!std::isfinite(error)) return min_step_factor;
  if (error == 0.0) return max_step_factor;
  return std::clamp(step_safety * portable::pow(error, -alpha) * portable::pow(error_before, step_beta), min_step_factor, max_step_factor);
}

// One step of its own, at most `interval`.
double advance(const Plan& plan, Motion& motion, Workspace& work, double interval) {
  const ErrorScale error_scale(plan, motion, work.tolerance.value_or(default_tolerance));
  MethodMemory& memory = motion.memory;
  if (!(memory.step > 0.0) || !(memory.error > 0.0)) memory = {.step = first_step(plan, interval), .error = min_step_error};

  bool rejected = false;
  while (true) {
    // equal steps to the end of the interval, none longer than the stored step
    const double steps = std::ceil(interval / memory.step * (1.0 - 1e-12));
    const double h = steps <= 1.0 ? interval : interval / steps;

    Step step(table, plan, motion, work, h);
    step.compute_slopes();
    const LocalError local = estimate_error(plan, motion, step, h);
    const double error = error_scale.relative(local.position, local.velocity);

    // the error is too large: repeat with a shorter step. The shortest step is taken whatever its error, since a force may be
    // discontinuous; the error counts in local_error
    const bool is_shortest = h <= work.min_step;
    if (!(error <= 1.0) && !is_shortest) {
      memory.step = std::max(work.min_step, h * std::min(1.0, step_factor(error, 1.0)));
      rejected = true;
      continue;
    }
    if (!std::isfinite(error)) return 0.0;

    step.finish();
    motion.local_error += local.position;

    // a step truncated by the end of the interval says little about the next one
    const double factor = step_factor(error, memory.error);
    memory.step = factor == max_step_factor ? std::max(memory.step, factor * h) : std::max(work.min_step, factor * h);
    if (rejected) memory.step = std::min(memory.step, h);
    memory.error = std::max(error, min_step_error);
    return h;
  }
}

// k_i = z (1 + sum_j A_ij k_j),  R = 1 + sum_i b_i k_i
std::complex<double> stability_function(std::complex<double> z) {
  std::array<std::complex<double>, stages> k;
  std::complex<double> r = 1.0;
  for (std::size_t i = 0; i < stages; ++i) {
    std::complex<double> y = 1.0;
    for (std::size_t j = 0; j < i; ++j) y += a[i][j] * k[j];
    k[i] = z * y;
    r += b[i] * k[i];
  }
  return r;
}

Amplification amplification(const Oscillator& oscillator) { return amplification_from(stability_function, oscillator); }

}  // namespace

constinit const Integrator dop853{
    .id = "dop853",
    .label = "Dormand-Prince 8(5,3)",
    .summary = "Eighth order with steps chosen by the tolerance: small errors, also with damping, and the reference for all other methods.",
    .cost = "twelve force evaluations for each of its own steps",
    .formula =
        "V_i = v + h sum_j A_ij a_j,   X_i = x + h c_i v + h^2 sum_j (A A)_ij a_j,   a_i = a(t + c_i h, X_i, V_i),   i = 1 ... 12\n"
        "x' = x + h v + h^2 sum b A a,   v' = v + h sum b a;   h from error estimates of order 5 and 3",
    .source = "E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.5 and II.10",
    .order = 8,
    .order_with = {.drag = 8, .damped = 8, .contact = 2, .force_terms = 8},
    .stability = Stability::Adaptive,
    .energy = EnergyTrend::Drifts,
    .prepare = prepare,
    .advance = advance,
    .amplification = amplification,
};

}  // namespace hooke
