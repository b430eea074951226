#include <algorithm>
#include <functional>
#include <limits>

#include "api/hooke.h"
#include "api/hooke_c.h"

using namespace hooke::v1;

struct hooke_scene {
  Scene of;
  std::string text{};  // the last one that was asked for
};
struct hooke_simulation {
  Simulation of;
  std::string text{};
};

namespace {

thread_local char last_error[4096];
thread_local int last_code = 0;

void note(int code, const char* error) {
  last_code = code;
  last_error[std::string_view(error).copy(last_error, sizeof last_error - 1)] = '\0';
}

// What `work` returns, or `failed`. No exception leaves a function of C.
template <class Value, class Work>
Value answer(Value failed, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    note(error.kind() == Error::Kind::Usage ? 2 : error.kind() == Error::Kind::Input ? 3 : 5, error.what());
  } catch (const std::exception& error) {
    note(5, error.what());
  } catch (...) {
    note(5, "unknown error");
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
template <class Member>
int64_t count(const hooke_simulation* simulation, Member member, int64_t size = 1) {
  return answer<int64_t>(-1, [&] { return static_cast<int64_t>((given(simulation)->of.*member)().size()) / size; });
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
const char* hooke_error() { return last_error; }
int hooke_error_code() { return last_code; }

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
int64_t hooke_scene_point_count(const hooke_scene* scene) { return ask<int64_t>(-1, scene, &S::point_count); }
int64_t hooke_scene_spring_count(const hooke_scene* scene) { return ask<int64_t>(-1, scene, &S::spring_count); }
const char* hooke_scene_json(hooke_scene* scene) {
  return answer<const char*>(nullptr, [&] { return given(scene), (scene->text = scene->of.json()).c_str(); });
}

hooke_simulation* hooke_simulation_new(const hooke_scene* scene, int accuracy) {
  return answer<hooke_simulation*>(nullptr, [&] {
    if (accuracy < HOOKE_ACCURACY_OFF || accuracy > HOOKE_ACCURACY_FULL) throw Error(Error::Kind::Usage, "accuracy: must be from 0 to 2");
    return new hooke_simulation{Simulation(given(scene)->of, static_cast<Simulation::Accuracy>(accuracy))};
  });
}
void hooke_simulation_free(hooke_simulation* simulation) { delete simulation; }
int hooke_simulation_frame(hooke_simulation* simulation) { return ask(-1, simulation, step_frame); }
int hooke_simulation_step(hooke_simulation* simulation, double seconds) { return ask(-1, simulation, step_seconds, seconds); }
int hooke_simulation_set_threads(hooke_simulation* simulation, int threads) { return call(simulation, &R::set_threads, threads); }
const char* hooke_simulation_diagnosis(hooke_simulation* simulation) {
  return answer<const char*>(nullptr, [&] { return given(simulation), (simulation->text = simulation->of.diagnosis()).c_str(); });
}

hooke_scene* hooke_simulation_scene(const hooke_simulation* simulation) {
  return make_scene([&] { return given(simulation)->of.scene(); });
}
double hooke_simulation_time(const hooke_simulation* simulation) { return ask(unknown, simulation, &R::time); }
uint64_t hooke_simulation_hash(const hooke_simulation* simulation) { return ask<uint64_t>(0, simulation, &R::hash); }
double hooke_simulation_error(const hooke_simulation* simulation) { return ask(unknown, simulation, &R::error); }
double hooke_simulation_frame_error(const hooke_simulation* simulation) { return ask(unknown, simulation, &R::frame_error); }
int hooke_simulation_energy(const hooke_simulation* simulation, double energy[3]) {
  return answer(-1, [&] {
    const Energy now = given(simulation)->of.energy();
    return std::ranges::copy(std::initializer_list<double>{now.kinetic, now.elastic, now.gravitational}, given(energy)), 0;
  });
}
int64_t hooke_simulation_point_count(const hooke_simulation* simulation) { return ask<int64_t>(-1, simulation, &R::point_count); }
int64_t hooke_simulation_spring_count(const hooke_simulation* simulation) {
  return count(simulation, &R::rest_lengths);
}
int64_t hooke_simulation_face_count(const hooke_simulation* simulation) { return count(simulation, &R::faces, 3); }
int64_t hooke_simulation_collider_count(const hooke_simulation* simulation) { return count(simulation, &R::colliders); }
const double* hooke_simulation_positions(const hooke_simulation* simulation) {
  return answer<const double*>(nullptr, [&] { return given(simulation)->of.positions().data(); });
}
const double* hooke_simulation_velocities(const hooke_simulation* simulation) {
  return answer<const double*>(nullptr, [&] { return given(simulation)->of.velocities().data(); });
}
int hooke_simulation_springs(const hooke_simulation* simulation, int64_t* points) { return fill(simulation, &R::springs, points); }
int hooke_simulation_faces(const hooke_simulation* simulation, int64_t* points) { return fill(simulation, &R::faces, points); }
int hooke_simulation_masses(const hooke_simulation* simulation, double* masses) { return fill(simulation, &R::masses, masses); }
int hooke_simulation_radii(const hooke_simulation* simulation, double* radii) { return fill(simulation, &R::radii, radii); }
int hooke_simulation_nailed(const hooke_simulation* simulation, int* nailed) { return fill(simulation, &R::nailed, nailed); }
int hooke_simulation_stiffness(const hooke_simulation* simulation, double* values) { return fill(simulation, &R::stiffness, values); }
int hooke_simulation_rest_lengths(const hooke_simulation* simulation, double* lengths) { return fill(simulation, &R::rest_lengths, lengths); }
int hooke_simulation_tensions(const hooke_simulation* simulation, double* tensions) { return fill(simulation, &R::tensions, tensions); }
int hooke_simulation_reactions(const hooke_simulation* simulation, double* reactions) { return fill(simulation, &R::reactions, reactions); }
int hooke_simulation_contact_forces(const hooke_simulation* simulation, double* forces) { return fill(simulation, &R::contact_forces, forces); }
int hooke_simulation_colliders(const hooke_simulation* simulation, hooke_collider* colliders) {
  return answer(-1, [&] {
    given(colliders);
    for (const auto& [kind, a, b, radius] : given(simulation)->of.colliders())
      *colliders++ = {static_cast<int>(kind), {a.x, a.y, a.z}, {b.x, b.y, b.z}, radius};
    return 0;
  });
}
int64_t hooke_simulation_contacts(const hooke_simulation* simulation, int64_t* points, int* kinds, int64_t* numbers, double* normals) {
  return answer<int64_t>(-1, [&] {
    given(kinds), given(numbers), given(normals);
    const std::vector<int64_t> touching = given(simulation)->of.contacts();
    std::ranges::copy(touching, given(points));
    for (const auto& [kind, number, normal] : simulation->of.contact_partners()) {
      *kinds++ = static_cast<int>(kind), *numbers++ = number;
      normals = std::ranges::copy(std::initializer_list<double>{normal.x, normal.y, normal.z}, normals).out;
    }
    return static_cast<int64_t>(touching.size());
  });
}

int hooke_simulation_grab(hooke_simulation* simulation, int64_t point, const double target[3]) {
  return call(simulation, &R::grab, point, target);
}
int hooke_simulation_pull(hooke_simulation* simulation, int64_t point, const double target[3], double stiffness) {
  return call(simulation, &R::pull, point, target, stiffness);
}
int hooke_simulation_move_hand(hooke_simulation* simulation, const double target[3]) { return call(simulation, &R::move_hand, target); }
int hooke_simulation_release(hooke_simulation* simulation) { return call(simulation, &R::release); }
int hooke_simulation_nail(hooke_simulation* simulation, int64_t point, int nailed) {
  return call(simulation, &R::nail, point, nailed != 0);
}
int hooke_simulation_move(hooke_simulation* simulation, int64_t point, const double position[3], const double velocity[3]) {
  return call(simulation, &R::move, point, position, velocity);
}
int hooke_simulation_set(hooke_simulation* simulation, const char* setting) { return call(simulation, &R::set, setting); }
int hooke_simulation_undo(hooke_simulation* simulation) { return call(simulation, &R::undo); }
int hooke_simulation_redo(hooke_simulation* simulation) { return call(simulation, &R::redo); }
// clang-format on
