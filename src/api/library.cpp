#include "api/library.h"

#include <glm/geometric.hpp>
#include <limits>

#include "base/build_info.h"
#include "base/file_limits.h"
#include "base/finite.h"
#include "base/printable.h"
#include "base/threads/thread_team.h"
#include "edit/append_parts.h"
#include "edit/command.h"
#include "edit/setting_text.h"
#include "formats/open_file.h"
#include "sim/forces/bands.h"
#include "sim/model/hash.h"

namespace hooke::v1 {
namespace {

// The interface throws nothing but Error.
template <class Work>
auto guarded(Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw Error(Error::Kind::Input, without_middle(error.what()));
  } catch (const OptionError& error) {
    throw Error(Error::Kind::Usage, without_middle(error.as_argument()));
  } catch (const UsageError& error) {
    throw Error(Error::Kind::Usage, without_middle(error.what()));
  } catch (const FileError& error) {
    throw Error(Error::Kind::File, without_middle(error.what()));
  }
}

Vec3 to_vec3(const char* name, const Vector& vector) {
  const Vec3 result(vector.x, vector.y, vector.z);
  if (!is_finite(result)) throw InputError(std::string(name) + ": must be finite numbers");
  return result;
}

PointId id_of(const System& system, std::int64_t point) {
  if (point < 0 || point >= system.point_count())
    throw InputError("point: " + std::to_string(point) + ": must be the number of one of the " + std::to_string(system.point_count()) +
                     " points, from 0");
  return system.points()[static_cast<std::size_t>(point)].id;
}

template <class Data>
Data* checked(Data* data, const char* what) {
  if (data == nullptr) throw Error(Error::Kind::Usage, std::string(what) + ": was moved from");
  return data;
}

void check_count(const char* what, std::uint64_t count, std::uint64_t max) {
  if (count > max) throw InputError(std::string(what) + ": " + std::to_string(count) + ": must be at most " + std::to_string(max));
}

std::span<const double> components(const std::vector<Vec3>& vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {vectors.empty() ? nullptr : &vectors.front().x, 3 * vectors.size()};
}

}  // namespace

Error::~Error() = default;

struct Scene::Data {
  hooke::Scene scene;
  std::string name = "scene";
};

Scene::Data& Scene::data() const { return *checked(data_.get(), "scene"); }

Scene::Scene() : data_(std::make_unique<Data>()) { data().scene = parse_scene("{\"hooke\": 1}", "scene").scene; }
Scene::Scene(const Scene& other) : data_(std::make_unique<Data>(other.data())) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene& other) {
  if (this != &other) data_ = std::make_unique<Data>(other.data());
  return *this;
}
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Scene Scene::load(const std::string& name) {
  return guarded([&] {
    Scene made;
    made.data() = {load_file(find_scene(name)).scene, name};
    return made;
  });
}

Scene Scene::parse(std::string_view json, const std::string& name) {
  return guarded([&] {
    Scene made;
    made.data() = {parse_scene(json, name).scene, name};
    return made;
  });
}

std::int64_t Scene::add_point(const Vector& position, double mass, bool nailed) {
  return guarded([&] {
    const System& system = data().scene.system;
    const Vec3 at = to_vec3("position", position);
    check_value("mass", mass, positive);
    check_count("points", system.points().size() + 1, max_points);
    if (system.dimensions == 2 && at.z != 0.0) throw InputError("position: z = " + format_exact(at.z) + ": must be 0 in a 2-D scene");
    Effect effect;
    apply(data().scene,
          Insert{.points = {{.point = {.id = data().scene.system.new_point_id(), .nailed = nailed, .mass = mass}, .position = at}}},
          effect);
    return std::int64_t{system.point_count()} - 1;
  });
}

std::int64_t Scene::add_spring(std::int64_t first, std::int64_t second, double stiffness, double damping) {
  return guarded([&] {
    const System& system = data().scene.system;
    const PointId from = id_of(system, first), to = id_of(system, second);
    if (first == second) throw InputError("points: must be two different points");
    check_value("stiffness", stiffness, not_negative);
    check_value("damping", damping, not_negative);
    check_count("springs", system.springs().size() + 1, max_springs);
    const std::vector<Vec3>& position = data().scene.state.position;
    const double length = glm::length(position[static_cast<std::size_t>(second)] - position[static_cast<std::size_t>(first)]);
    const Spring spring{.id = data().scene.system.new_spring_id(),
                        .first = from,
                        .second = to,
                        .stiffness = stiffness,
                        .damping = damping,
                        .rest_length = length};
    Effect effect;
    apply(data().scene, Insert{.springs = {{.spring = spring}}}, effect);
    return std::int64_t{system.spring_count()} - 1;
  });
}

void Scene::add(std::string_view members) {
  guarded([&] { add_members(data().scene, members, data().name); });
}

void Scene::set(const std::string& setting) {
  guarded([&] { apply_setting(data().scene, parse_setting(setting), data().name); });
}

void Scene::set_integrator(const std::string& id) {
  guarded([&] { data().scene.settings.integrator = &parse_integrator(id); });
}

void Scene::set_substeps(int substeps) {
  guarded([&] {
    check_option("substeps", substeps, {.min = 1, .max = max_substeps});
    data().scene.settings.substeps = substeps;
  });
}

void Scene::set_frame_rate(double frame_rate) {
  guarded([&] {
    check_option("frame-rate", frame_rate, positive);
    data().scene.settings.frame_rate = frame_rate;
  });
}

std::int64_t Scene::point_count() const { return data().scene.system.point_count(); }
std::int64_t Scene::spring_count() const { return data().scene.system.spring_count(); }

std::string Scene::json() const {
  return guarded([&] { return format_scene(data().scene); });
}

void Scene::save(const std::string& file) const {
  guarded([&] { write_scene_as(data().scene, file); });
}

Simulation::Data& Simulation::data() const { return *checked(data_.get(), "simulation"); }

Simulation::Simulation(const Scene& scene, Accuracy accuracy) {
  using enum Accuracy;
  data_ = guarded([&] { return std::make_unique<Data>(Data{Lab(scene.data().scene, KeepStart::No), scene.data().name}); });
  data().submit(SetAccuracy{accuracy == Full ? AccuracyMode::Full : accuracy == Frame ? AccuracyMode::Frame : AccuracyMode::Off});
}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

bool Simulation::step() {
  return guarded([&] { return data().lab.step(); });
}

bool Simulation::step(double seconds) {
  return guarded([&] {
    check_option("seconds", seconds, {.min = 0.0, .max = 1e9});
    constexpr double round_off = 1e-9;
    const double frames = seconds * data().lab.scene().settings.frame_rate;
    for (double frame = 0.0; frame < frames * (1.0 - round_off) - round_off; ++frame)
      if (!data().lab.step()) return false;
    return true;
  });
}

void Simulation::set_threads(int threads) {
  guarded([&] {
    check_option("threads", threads, {.min = 1, .max = max_parts});
    data().lab.set_execution({.team = threads > 1 ? std::make_shared<ThreadTeam>(threads) : nullptr, .single = nullptr});
  });
}

std::string Simulation::diagnosis() const {
  data().lab.publish();
  return data().lab.status()->diagnosis.message;
}

double Simulation::time() const { return data().lab.scene().state.time; }
std::uint64_t Simulation::hash() const { return hash_state(data().lab.scene().state); }

Energy Simulation::energy() const {
  const hooke::Energy& energy = data().lab.energy();
  return {energy.kinetic, energy.elastic, energy.gravitational};
}

std::span<const double> Simulation::positions() const { return components(data().lab.scene().state.position); }
std::span<const double> Simulation::velocities() const { return components(data().lab.scene().state.velocity); }

double Simulation::error() const { return data().lab.accuracy().accumulated.value.value_or(std::numeric_limits<double>::quiet_NaN()); }
double Simulation::frame_error() const { return data().lab.accuracy().frame.value.value_or(std::numeric_limits<double>::quiet_NaN()); }

void Simulation::grab(std::int64_t point, const Vector& target) {
  guarded([&] {
    const PointId id = id_of(data().lab.scene().system, point);
    data().submit(GrabPoint{{.point = id, .kind = GrabKind::Hold, .target = to_vec3("target", target)}});
  });
}

void Simulation::pull(std::int64_t point, const Vector& target, double stiffness) {
  guarded([&] {
    check_value("stiffness", stiffness, not_negative);
    const PointId id = id_of(data().lab.scene().system, point);
    data().submit(GrabPoint{{.point = id, .kind = GrabKind::Pull, .target = to_vec3("target", target), .stiffness = stiffness}});
  });
}

void Simulation::move_hand(const Vector& target) {
  guarded([&] { data().submit(MoveHand{to_vec3("target", target)}); });
}

void Simulation::release() { data().submit(ReleaseHand{}); }

void Simulation::nail(std::int64_t point, bool nailed) {
  guarded([&] { data().submit(SetNailed{{{id_of(data().lab.scene().system, point), nailed}}}); });
}

void Simulation::move(std::int64_t point, const Vector& position, const Vector& velocity) {
  guarded([&] {
    const PointId id = id_of(data().lab.scene().system, point);
    data().submit(Move{{{id, to_vec3("position", position), to_vec3("velocity", velocity)}}});
  });
}

void Simulation::set(const std::string& setting) {
  guarded([&] { data().submit(parse_setting(setting)); });
}

void Simulation::undo() { data().submit(Undo{}); }
void Simulation::redo() { data().submit(Redo{}); }

Scene Simulation::scene() const {
  Scene copy;
  *copy.data_ = {data().lab.scene(), data().name};
  return copy;
}

const char* version() { return program_version; }

}  // namespace hooke::v1
