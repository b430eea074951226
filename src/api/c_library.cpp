#include <algorithm>
#include <limits>

#include "api/hooke.h"
#include "api/hooke_c.h"

using namespace hooke::v1;

struct hooke_scene {
  Scene scene;
};
struct hooke_simulation {
  Simulation simulation;
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
    last_error = error.what();
    return failed;
  }
}

// 0, or -1.
template <class Work>
int done(Work work) {
  return answer(-1, [&] { return work(), 0; });
}

template <class Handle>
Handle& given(Handle* handle) {
  if (handle == nullptr) throw Error(Error::Kind::Usage, "handle: must not be null");
  return *handle;
}
const char* given(const char* text) {
  if (text == nullptr) throw Error(Error::Kind::Usage, "text: must not be null");
  return text;
}
const Scene& of(const hooke_scene* handle) { return given(handle).scene; }
Scene& of(hooke_scene* handle) { return given(handle).scene; }
const Simulation& of(const hooke_simulation* handle) { return given(handle).simulation; }
Simulation& of(hooke_simulation* handle) { return given(handle).simulation; }
Vector vector(const double* components) {
  given(components);
  return {components[0], components[1], components[2]};
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

const char* hooke_version() { return version(); }
const char* hooke_error() { return last_error.c_str(); }

hooke_scene* hooke_scene_new() {
  return answer<hooke_scene*>(nullptr, [] { return new hooke_scene{Scene()}; });
}
hooke_scene* hooke_scene_load(const char* name) {
  return answer<hooke_scene*>(nullptr, [&] { return new hooke_scene{Scene::load(given(name))}; });
}
hooke_scene* hooke_scene_parse(const char* json) {
  return answer<hooke_scene*>(nullptr, [&] { return new hooke_scene{Scene::parse(given(json))}; });
}
void hooke_scene_free(hooke_scene* scene) { delete scene; }
int hooke_scene_add(hooke_scene* scene, const char* members) {
  return done([&] { of(scene).add(given(members)); });
}
int64_t hooke_scene_add_point(hooke_scene* scene, const double position[3], double mass, int nailed) {
  return answer<int64_t>(-1, [&] { return of(scene).add_point(vector(position), mass, nailed != 0); });
}
int64_t hooke_scene_add_spring(hooke_scene* scene, int64_t first, int64_t second, double stiffness, double damping) {
  return answer<int64_t>(-1, [&] { return of(scene).add_spring(first, second, stiffness, damping); });
}
int hooke_scene_set(hooke_scene* scene, const char* setting) {
  return done([&] { of(scene).set(given(setting)); });
}
int hooke_scene_set_integrator(hooke_scene* scene, const char* id) {
  return done([&] { of(scene).set_integrator(given(id)); });
}
int hooke_scene_save(hooke_scene* scene, const char* file) {
  return done([&] { of(scene).save(given(file)); });
}

hooke_simulation* hooke_simulation_new(const hooke_scene* scene, int accuracy) {
  return answer<hooke_simulation*>(nullptr, [&] {
    if (accuracy < HOOKE_ACCURACY_OFF || accuracy > HOOKE_ACCURACY_FULL) throw Error(Error::Kind::Usage, "accuracy: must be from 0 to 2");
    return new hooke_simulation{Simulation(of(scene), static_cast<Simulation::Accuracy>(accuracy)), {}};
  });
}
void hooke_simulation_free(hooke_simulation* simulation) { delete simulation; }
int hooke_simulation_frame(hooke_simulation* simulation) {
  return answer(-1, [&] { return of(simulation).step() ? 1 : 0; });
}
int hooke_simulation_step(hooke_simulation* simulation, double seconds) {
  return answer(-1, [&] { return of(simulation).step(seconds) ? 1 : 0; });
}
int hooke_simulation_set_threads(hooke_simulation* simulation, int threads) {
  return done([&] { of(simulation).set_threads(threads); });
}
const char* hooke_simulation_diagnosis(hooke_simulation* simulation) {
  return answer<const char*>(nullptr, [&] { return (given(simulation).diagnosis = of(simulation).diagnosis()).c_str(); });
}

double hooke_simulation_time(const hooke_simulation* simulation) {
  return answer(unknown, [&] { return of(simulation).time(); });
}
uint64_t hooke_simulation_hash(const hooke_simulation* simulation) {
  return answer<uint64_t>(0, [&] { return of(simulation).hash(); });
}
double hooke_simulation_error(const hooke_simulation* simulation) {
  return answer(unknown, [&] { return of(simulation).error(); });
}
int hooke_simulation_energy(const hooke_simulation* simulation, double energy[3]) {
  return done([&] {
    const Energy now = of(simulation).energy();
    given(energy), energy[0] = now.kinetic, energy[1] = now.elastic, energy[2] = now.gravitational;
  });
}
int64_t hooke_simulation_point_count(const hooke_simulation* simulation) {
  return answer<int64_t>(-1, [&] { return of(simulation).point_count(); });
}
int64_t hooke_simulation_spring_count(const hooke_simulation* simulation) {
  return answer<int64_t>(-1, [&] { return static_cast<int64_t>(of(simulation).rest_lengths().size()); });
}
const double* hooke_simulation_positions(const hooke_simulation* simulation) {
  return answer<const double*>(nullptr, [&] { return of(simulation).positions().data(); });
}
const double* hooke_simulation_velocities(const hooke_simulation* simulation) {
  return answer<const double*>(nullptr, [&] { return of(simulation).velocities().data(); });
}
int hooke_simulation_springs(const hooke_simulation* simulation, int64_t* points) {
  return done([&] { std::ranges::copy(of(simulation).springs(), &given(points)); });
}
int hooke_simulation_tensions(const hooke_simulation* simulation, double* tensions) {
  return done([&] { std::ranges::copy(of(simulation).tensions(), &given(tensions)); });
}
int hooke_simulation_reactions(const hooke_simulation* simulation, double* reactions) {
  return done([&] { std::ranges::copy(of(simulation).reactions(), &given(reactions)); });
}

int hooke_simulation_grab(hooke_simulation* simulation, int64_t point, const double target[3]) {
  return done([&] { of(simulation).grab(point, vector(target)); });
}
int hooke_simulation_move_hand(hooke_simulation* simulation, const double target[3]) {
  return done([&] { of(simulation).move_hand(vector(target)); });
}
int hooke_simulation_release(hooke_simulation* simulation) {
  return done([&] { of(simulation).release(); });
}
int hooke_simulation_nail(hooke_simulation* simulation, int64_t point, int nailed) {
  return done([&] { of(simulation).nail(point, nailed != 0); });
}
int hooke_simulation_set(hooke_simulation* simulation, const char* setting) {
  return done([&] { of(simulation).set(given(setting)); });
}
