// Compiled once for each vector unit by Highway.
#include "study/kernels/machine_loops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "study/kernels/machine_loops.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Each chain waits for its own previous result only: 12 cover the latency of two units.
template <class T>
T repeat_fma(std::size_t rounds) {
  const hn::ScalableTag<T> d;
  const auto factor = hn::Set(d, T(0.999)), term = hn::Set(d, T(0.001));
  auto a0 = hn::Set(d, T(0.0)), a1 = hn::Set(d, T(0.1)), a2 = hn::Set(d, T(0.2)), a3 = hn::Set(d, T(0.3));
  auto a4 = hn::Set(d, T(0.4)), a5 = hn::Set(d, T(0.5)), a6 = hn::Set(d, T(0.6)), a7 = hn::Set(d, T(0.7));
  auto a8 = hn::Set(d, T(0.8)), a9 = hn::Set(d, T(0.9)), a10 = hn::Set(d, T(1.0)), a11 = hn::Set(d, T(1.1));
  for (std::size_t round = 0; round < rounds; ++round) {
    a0 = hn::MulAdd(a0, factor, term);
    a1 = hn::MulAdd(a1, factor, term);
    a2 = hn::MulAdd(a2, factor, term);
    a3 = hn::MulAdd(a3, factor, term);
    a4 = hn::MulAdd(a4, factor, term);
    a5 = hn::MulAdd(a5, factor, term);
    a6 = hn::MulAdd(a6, factor, term);
    a7 = hn::MulAdd(a7, factor, term);
    a8 = hn::MulAdd(a8, factor, term);
    a9 = hn::MulAdd(a9, factor, term);
    a10 = hn::MulAdd(a10, factor, term);
    a11 = hn::MulAdd(a11, factor, term);
  }
  const auto first = hn::Add(hn::Add(hn::Add(a0, a1), hn::Add(a2, a3)), hn::Add(hn::Add(a4, a5), hn::Add(a6, a7)));
  return hn::GetLane(hn::Add(first, hn::Add(hn::Add(a8, a9), hn::Add(a10, a11))));
}

template <class T>
void take_roots(const T* HWY_RESTRICT x, T* HWY_RESTRICT y, std::size_t count) {
  const hn::ScalableTag<T> d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) hn::StoreU(hn::Sqrt(hn::LoadU(d, x + i)), d, y + i);
}

template <class T>
void divide(const T* HWY_RESTRICT x, T* HWY_RESTRICT y, std::size_t count) {
  const hn::ScalableTag<T> d;
  const auto one = hn::Set(d, T(1.5));
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) hn::StoreU(hn::Div(one, hn::LoadU(d, x + i)), d, y + i);
}

void stream_triad(double* HWY_RESTRICT a, const double* HWY_RESTRICT b, const double* HWY_RESTRICT c, std::size_t count) {
  const hn::ScalableTag<double> d;
  const auto s = hn::Set(d, 0.5);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) hn::StoreU(hn::MulAdd(s, hn::LoadU(d, c + i), hn::LoadU(d, b + i)), d, a + i);
}

std::size_t lanes_of_doubles() { return hn::Lanes(hn::ScalableTag<double>()); }
std::size_t lanes_of_floats() { return hn::Lanes(hn::ScalableTag<float>()); }
double repeat_fma_of_doubles(std::size_t rounds) { return repeat_fma<double>(rounds); }
float repeat_fma_of_floats(std::size_t rounds) { return repeat_fma<float>(rounds); }
void take_roots_of_doubles(const double* x, double* y, std::size_t count) { take_roots(x, y, count); }
void take_roots_of_floats(const float* x, float* y, std::size_t count) { take_roots(x, y, count); }
void divide_doubles(const double* x, double* y, std::size_t count) { divide(x, y, count); }
void divide_floats(const float* x, float* y, std::size_t count) { divide(x, y, count); }

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(lanes_of_doubles);
HWY_EXPORT(lanes_of_floats);
HWY_EXPORT(repeat_fma_of_doubles);
HWY_EXPORT(repeat_fma_of_floats);
HWY_EXPORT(take_roots_of_doubles);
HWY_EXPORT(take_roots_of_floats);
HWY_EXPORT(divide_doubles);
HWY_EXPORT(divide_floats);
HWY_EXPORT(stream_triad);

template <>
std::size_t vector_lanes<double>() {
  return HWY_DYNAMIC_DISPATCH(lanes_of_doubles)();
}
template <>
std::size_t vector_lanes<float>() {
  return HWY_DYNAMIC_DISPATCH(lanes_of_floats)();
}
template <>
double run_fma<double>(std::size_t rounds) {
  return HWY_DYNAMIC_DISPATCH(repeat_fma_of_doubles)(rounds);
}
template <>
float run_fma<float>(std::size_t rounds) {
  return HWY_DYNAMIC_DISPATCH(repeat_fma_of_floats)(rounds);
}
void run_sqrt(const double* x, double* y, std::size_t count) { HWY_DYNAMIC_DISPATCH(take_roots_of_doubles)(x, y, count); }
void run_sqrt(const float* x, float* y, std::size_t count) { HWY_DYNAMIC_DISPATCH(take_roots_of_floats)(x, y, count); }
void run_division(const double* x, double* y, std::size_t count) { HWY_DYNAMIC_DISPATCH(divide_doubles)(x, y, count); }
void run_division(const float* x, float* y, std::size_t count) { HWY_DYNAMIC_DISPATCH(divide_floats)(x, y, count); }
void run_triad(double* a, const double* b, const double* c, std::size_t count) { HWY_DYNAMIC_DISPATCH(stream_triad)(a, b, c, count); }

}  // namespace hooke
#endif
