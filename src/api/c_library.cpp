#include <algorithm>
#include <functional>
#include <limits>

#include "api/hooke.h"
#include "api/hooke_c.h"

using namespace hooke::v1;

struct hooke_scene {
  Scene of;
};
struct hooke_simulation {
  Simulation of;
  std::string diagnosis;
};

namespace {

thread_local std::string last_error;

// What `work` returns, or `failed`. No exception leaves a function of C.
template <class Value, class Work>
Value answer(Value failed, Work work) {
  try {
    return work();
  } catch (const std::exception& error) {
    try {
      last_error = error.what();
    } catch (...) {
      last_error.clear();
    }
  } catch (...) {
    last_error.clear();
  }
  return failed;
}

template <class Pointer>
Pointer given(Pointer pointer) {
  if (pointer == nullptr) throw Error(Error::Kind::Usage, "pointer: must not be null");
  return pointer;
}

// An argument of C as the interface for C++ takes it.
template <class Value>
Value converted(Value value) {
  return value;
}
std::string converted(const char* text) { return given(text); }
Vector converted(const double* components) { return {given(components)[0], components[1], components[2]}; }

// What a member function of the object of a handle returns.
template <class Value, class Handle, class Member, class... Arguments>
Value ask(Value failed, Handle* handle, Member member, Arguments... arguments) {
  return answer(failed, [&] { return static_cast<Value>((given(handle)->of.*member)(converted(arguments)...)); });
}
// 0, or -1.
template <class Handle, class Member, class... Arguments>
int call(Handle* handle, Member member, Arguments... arguments) {
  return answer(-1, [&] { return (given(handle)->of.*member)(converted(arguments)...), 0; });
}
template <class Value, class Member>
int fill(const hooke_simulation* simulation, Member member, Value* values) {
  return answer(-1, [&] { return std::ranges::copy((given(simulation)->of.*member)(), given(values)), 0; });
}
template <class Make>
hooke_scene* make_scene(Make make) {
  return answer<hooke_scene*>(nullptr, [&] { return new hooke_scene{make()}; });
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
using S = Scene;
using R = Simulation;
constexpr bool (R::*step_frame)() = &R::step;
constexpr bool (R::*step_seconds)(double) = &R::step;

}  // namespace

// one function a line
// clang-format off
const char* hooke_version() { return version(); }
const char* hooke_error() { return last_error.c_str(); }

hooke_scene* hooke_scene_new() { return make_scene([] { return Scene(); }); }
hooke_scene* hooke_scene_load(const char* name) { return make_scene([&] { return Scene::load(given(name)); }); }
hooke_scene* hooke_scene_parse(const char* json) { return make_scene([&] { return Scene::parse(given(json)); }); }
void hooke_scene_free(hooke_scene* scene) { delete scene; }
int hooke_scene_add(hooke_scene* scene, const char* members) { return call(scene, &S::add, members); }
int64_t hooke_scene_add_point(hooke_scene* scene, const double position[3], double mass, int nailed) {
  return ask<int64_t>(-1, scene, &S::add_point, position, mass, nailed != 0);
}
int64_t hooke_scene_add_spring(hooke_scene* scene, int64_t first, int64_t second, double stiffness, double damping) {
  return ask<int64_t>(-1, scene, &S::add_spring, first, second, stiffness, damping);
}
int hooke_scene_set(hooke_scene* scene, const char* setting) { return call(scene, &S::set, setting); }
int hooke_scene_set_integrator(hooke_scene* scene, const char* id) { return call(scene, &S::set_integrator, id); }
int hooke_scene_save(hooke_scene* scene, const char* file) { return call(scene, &S::save, file); }

hooke_simulation* hooke_simulation_new(const hooke_scene* scene, int accuracy) {
  return answer<hooke_simulation*>(nullptr, [&] {
    if (accuracy < HOOKE_ACCURACY_OFF || accuracy > HOOKE_ACCURACY_FULL) throw Error(Error::Kind::Usage, "accuracy: must be from 0 to 2");
    return new hooke_simulation{Simulation(given(scene)->of, static_cast<Simulation::Accuracy>(accuracy)), {}};
  });
}
void hooke_simulation_free(hooke_simulation* simulation) { delete simulation; }
int hooke_simulation_frame(hooke_simulation* simulation) { return ask(-1, simulation, step_frame); }
int hooke_simulation_step(hooke_simulation* simulation, double seconds) { return ask(-1, simulation, step_seconds, seconds); }
int hooke_simulation_set_threads(hooke_simulation* simulation, int threads) { return call(simulation, &R::set_threads, threads); }
const char* hooke_simulation_diagnosis(hooke_simulation* simulation) {
  return answer<const char*>(nullptr, [&] {
    std::string diagnosis = given(simulation)->of.diagnosis();
    return (simulation->diagnosis = std::move(diagnosis)).c_str();
  });
}

double hooke_simulation_time(const hooke_simulation* simulation) { return ask(unknown, simulation, &R::time); }
uint64_t hooke_simulation_hash(const hooke_simulation* simulation) { return ask<uint64_t>(0, simulation, &R::hash); }
double hooke_simulation_error(const hooke_simulation* simulation) { return ask(unknown, simulation, &R::error); }
int hooke_simulation_energy(const hooke_simulation* simulation, double energy[3]) {
  return answer(-1, [&] {
    const Energy now = given(simulation)->of.energy();
    return std::ranges::copy(std::initializer_list<double>{now.kinetic, now.elastic, now.gravitational}, given(energy)), 0;
  });
}
int64_t hooke_simulation_point_count(const hooke_simulation* simulation) { return ask<int64_t>(-1, simulation, &R::point_count); }
int64_t hooke_simulation_spring_count(const hooke_simulation* simulation) {
  return answer<int64_t>(-1, [&] { return static_cast<int64_t>(given(simulation)->of.rest_lengths().size()); });
}
const double* hooke_simulation_positions(const hooke_simulation* simulation) {
  return answer<const double*>(nullptr, [&] { return given(simulation)->of.positions().data(); });
}
const double* hooke_simulation_velocities(const hooke_simulation* simulation) {
  return answer<const double*>(nullptr, [&] { return given(simulation)->of.velocities().data(); });
}
int hooke_simulation_springs(const hooke_simulation* simulation, int64_t* points) { return fill(simulation, &R::springs, points); }
int hooke_simulation_tensions(const hooke_simulation* simulation, double* tensions) { return fill(simulation, &R::tensions, tensions); }
int hooke_simulation_reactions(const hooke_simulation* simulation, double* reactions) { return fill(simulation, &R::reactions, reactions); }
int hooke_simulation_contact_forces(const hooke_simulation* simulation, double* forces) { return fill(simulation, &R::contact_forces, forces); }

int hooke_simulation_grab(hooke_simulation* simulation, int64_t point, const double target[3]) {
  return call(simulation, &R::grab, point, target);
}
int hooke_simulation_move_hand(hooke_simulation* simulation, const double target[3]) { return call(simulation, &R::move_hand, target); }
int hooke_simulation_release(hooke_simulation* simulation) { return call(simulation, &R::release); }
int hooke_simulation_nail(hooke_simulation* simulation, int64_t point, int nailed) {
  return call(simulation, &R::nail, point, nailed != 0);
}
int hooke_simulation_set(hooke_simulation* simulation, const char* setting) { return call(simulation, &R::set, setting); }
// clang-format on
