#include "python/lab_binding.h"

#include <pybind11/stl.h>

#include <glm/geometric.hpp>

#include "base/finite.h"
#include "batch/run_report.h"
#include "formats/open_file.h"
#include "lab/loads.h"
#include "lab/recording.h"
#include "scene/flatness.h"
#include "scene/parameters.h"
#include "sim/model/hash.h"

namespace hooke::python {
namespace {

using namespace py::literals;

// Applied at once, in effect from the next frame on.
template <class Request>
void submit(NamedLab& lab, Request request) {
  lab.lab.submit(std::move(request));
  lab.lab.apply_pending();
}

template <class Request>
void change(NamedLab& lab, Request request) {
  const Change guard(lab);
  submit(lab, std::move(request));
}

// `kind`: "point" or "spring".
template <class Items>
auto id_of(const Items& items, const std::string& kind, std::int64_t number) {
  if (number < 0 || number >= std::ssize(items))
    throw InputError(kind + ": " + std::to_string(number) + ": must be the number of one of the " + std::to_string(items.size()) + " " +
                     kind + "s, from 0");
  return items[static_cast<std::size_t>(number)].id;
}
PointId id_of(const NamedLab& lab, std::int64_t point) { return id_of(lab.lab.scene().system.points(), "point", point); }

Vec3 vector_from(const std::string& name, const Doubles& values) {
  if (values.ndim() != 1 || values.shape(0) != 3) throw InputError(name + ": shape " + shape_of(values) + ": must be (3,)");
  const Vec3 vector(values.at(0), values.at(1), values.at(2));
  if (!is_finite(vector)) throw InputError(name + ": must be finite numbers");
  return vector;
}

// False: the run diverged, and the state is that of the last valid frame.
bool step(NamedLab& lab, std::int64_t frames, py::object progress) {
  check_option("frames", static_cast<double>(frames), not_negative);
  if (lab.is_in_run) throw UsageError("step: not allowed in on_frame: the run computes the frames");
  const Change guard(lab);
  Watch watch(std::move(progress));
  const WatchedLab watched(lab.lab, watch);
  const py::gil_scoped_release unlocked;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const bool is_valid = lab.lab.step();
    watch.check(frame + 1, frames);
    if (!is_valid) return false;
  }
  return true;
}

void grab(NamedLab& lab, std::int64_t point, const Doubles& target, std::optional<double> pull) {
  if (pull) check_option("pull", *pull, not_negative);
  const Change guard(lab);
  GrabPoint::Item item{.point = id_of(lab, point), .kind = pull ? GrabKind::Pull : GrabKind::Hold, .target = vector_from("target", target)};
  if (pull) item.stiffness = *pull;
  submit(lab, GrabPoint{item});
}

// (point, stiffness [N/m] of its pull or None, its position and target [m]); None: the hand is free.
py::object hand_of(NamedLab& lab) {
  const Use use(lab);
  const Scene& scene = lab.lab.scene();
  const auto& grab = scene.system.grab;
  if (!grab) return py::none();
  const py::object pull = grab->kind == GrabKind::Pull ? py::object(py::float_(grab->stiffness)) : py::none();
  return py::make_tuple(scene.system.index_of(grab->point), pull, to_array(std::array{scene.state.hand.position, scene.state.hand.target}));
}

void nail(NamedLab& lab, const std::vector<std::int64_t>& points, bool nailed) {
  const Change guard(lab);
  SetNailed set;
  for (const std::int64_t point : points) set.items.push_back({id_of(lab, point), nailed});
  submit(lab, set);
}

void remove(NamedLab& lab, const std::vector<std::int64_t>& points, const std::vector<std::int64_t>& springs) {
  const Change guard(lab);
  Remove remove;
  for (const std::int64_t point : points) remove.points.push_back(id_of(lab, point));
  for (const std::int64_t spring : springs) remove.springs.push_back(id_of(lab.lab.scene().system.springs(), "spring", spring));
  submit(lab, remove);
}

void set_state(NamedLab& lab, const Doubles& positions, const Doubles& velocities) {
  const Change guard(lab);
  const Scene& scene = lab.lab.scene();
  const std::size_t count = scene.system.points().size();
  const std::vector<Vec3> position = flat_vectors(scene.system, "positions", positions, count);
  const std::vector<Vec3> velocity = flat_vectors(scene.system, "velocities", velocities, count);
  Move move;
  for (std::size_t i = 0; i < count; ++i) move.items.push_back({scene.system.points()[i].id, position[i], velocity[i]});
  submit(lab, move);
}

void set(NamedLab& lab, const std::string& name, const std::string& value) {
  const SetParameter setting = setting_of("lab", name, value);
  const Change guard(lab);
  if (setting.parameter == &dimensions_parameter && setting.value == 0.0)
    if (const std::string reason = why_not_flat(lab.lab.scene().system, lab.lab.scene().state); !reason.empty())
      throw InputError("lab[\"dimensions\"]: " + value + ": " + reason);
  submit(lab, setting);
}

void record(NamedLab& lab, const std::string& file) {
  const Use use(lab);
  submit(lab, Record{std::make_shared<const std::filesystem::path>(file)});
  lab.lab.publish();
  if (const std::string& error = lab.lab.status()->recording.error; !error.empty()) throw FileError(error);
}

std::pair<std::string, std::string> history_of(NamedLab& lab) {
  const Use use(lab);
  lab.lab.publish();
  return {lab.lab.status()->history.undo_name, lab.lab.status()->history.redo_name};
}

// Unfinished after an interrupt; the next call continues.
void measure_accuracy(NamedLab& lab) {
  const Use use(lab);
  Watch watch((py::none()));
  const py::gil_scoped_release unlocked;
  lab.lab.measure_accuracy([&] {
    watch.check();
    return true;
  });
}

py::object diagnosis_of(NamedLab& lab, const NamedScene* start, double seconds) {
  const Use use(lab);
  Watch watch((py::none()));
  std::string text;
  {
    const py::gil_scoped_release unlocked;
    text = explain_divergence(lab.lab, start == nullptr ? nullptr : &start->scene(), seconds, [&] { watch.check(0, 0); });
  }
  return text.empty() ? py::object(py::none()) : py::object(py::str(text));
}

// The array in `kept`, made if the state has changed since.
py::object array_of(NamedLab& lab, py::object NamedLab::*kept, std::vector<Vec3> State::*field) {
  const Use use(lab);
  if (!(lab.*kept)) lab.*kept = read_only(to_array(lab.lab.scene().state.*field));
  return lab.*kept;
}

// {"kinetic", ..., "total"} [J].
py::dict energy_of(NamedLab& lab) {
  const Use use(lab);
  const Energy& energy = lab.lab.energy();
  return py::dict("kinetic"_a = energy.kinetic, "elastic"_a = energy.elastic, "gravitational"_a = energy.gravitational,
                  "total"_a = energy.total());
}

// {"strain" [1], "tension" [N], "spring_energy" [J], "forces", "loads", "reactions", "contact" [N]}: of springs, then of points.
py::dict loads_of(NamedLab& lab) {
  const Use use(lab);
  const Scene& scene = lab.lab.scene();
  const Loads loads = compute_loads(lab.lab);
  std::vector<double> strains;
  std::vector<Vec3> forces;
  for (const Spring& spring : scene.system.springs()) {
    strains.push_back(strain(scene.system, scene.state, spring));
    const Vec3 apart =
        scene.state.position[scene.system.index_of(spring.second)] - scene.state.position[scene.system.index_of(spring.first)];
    const double length = glm::length(apart);
    forces.push_back(length > 0.0 ? apart * (loads.tension[forces.size()] / length) : Vec3(0.0));
  }
  return py::dict("strain"_a = to_array(strains), "tension"_a = to_array(loads.tension), "spring_energy"_a = to_array(loads.energy),
                  "forces"_a = to_array(forces), "loads"_a = to_array(loads.external), "reactions"_a = to_array(loads.reaction),
                  "contact"_a = to_array(loads.contact));
}

// (point, kind, number, normal, force [N]) of each contact.
py::list contacts_of(NamedLab& lab) {
  constexpr const char* kinds[] = {"unknown", "collider", "point", "spring", "face"};
  const Use use(lab);
  py::list rows;
  for (const Contact& each : find_contacts(lab.lab))
    rows.append(py::make_tuple(each.point, kinds[static_cast<std::size_t>(each.partner)], each.number,
                               py::tuple(py::cast(std::array{each.normal.x, each.normal.y, each.normal.z})),
                               py::tuple(py::cast(std::array{each.force.x, each.force.y, each.force.z}))));
  return rows;
}

// {"since" [s], "change", ..., "method" [J]}; None: not measured.
py::object energy_balance_of(NamedLab& lab) {
  const Use use(lab);
  const Accuracy accuracy = lab.lab.accuracy();
  if (!accuracy.is_on) return py::none();
  py::dict entry;
  entry["since"] = accuracy.energy.since;
  for (const auto& [name, joules] : accuracy.energy.terms()) entry[name] = joules;
  return entry;
}

// {"frame", "frame_max", "accumulated" [m], "amplification" [1], "predictable" [s]}; None: not known.
py::dict error_of(NamedLab& lab) {
  measure_accuracy(lab);
  const Use use(lab);
  const Accuracy accuracy = lab.lab.accuracy();
  return py::dict("frame"_a = accuracy.frame.value, "frame_max"_a = accuracy.frame_max.value, "accumulated"_a = accuracy.accumulated.value,
                  "amplification"_a = accuracy.amplification.value, "predictable"_a = accuracy.predictable.value);
}

// (frames, hash, difference)
py::tuple replay(const std::string& file, std::int64_t threads, py::object progress) {
  const auto recording = std::make_shared<const Recording>(read_recording(file));
  Lab lab(*recording->start, KeepStart::No);
  lab.set_execution(execution_of(lab, threads));
  lab.submit(Play{recording});
  Watch watch(std::move(progress));
  const WatchedLab watched(lab, watch);
  long frames = 0;
  {
    const py::gil_scoped_release unlocked;
    lab.advance(0.0, [] { return true; });
    while (lab.is_playing()) {
      lab.step();
      watch.check(++frames, recording->frames);
    }
  }
  const bool is_cut = recording->is_truncated && lab.difference().empty();
  return py::make_tuple(frames, to_hexadecimal(hash_state(lab.scene().state)), is_cut ? truncated_recording : lab.difference());
}

}  // namespace

AccuracyMode accuracy_named(const std::string& name) {
  if (name == "off") return AccuracyMode::Off;
  if (name == "frame") return AccuracyMode::Frame;
  if (name == "full") return AccuracyMode::Full;
  throw OptionError("accuracy", name, must_be_one_of("off, frame, full", name));
}

void bind_lab(py::module_& module) {
  py::class_<NamedLab, std::shared_ptr<NamedLab>>(module, "Lab")
      .def(py::init([](const NamedScene& scene, const std::string& accuracy, std::int64_t threads, const std::string& precision,
                       const std::string& device) {
        const AccuracyMode mode = accuracy_named(accuracy);
        auto lab = std::make_shared<NamedLab>(scene, KeepStart::Yes);
        lab->accuracy = accuracy;
        lab->threads = threads, lab->precision = precision, lab->device = device;
        lab->lab.set_execution(execution_of(lab->lab, threads, precision, device));
        submit(*lab, SetAccuracy{mode});
        return lab;
      }))
      .def("step", &step)
      .def("grab", &grab)
      .def_property_readonly("hand", &hand_of)
      .def("move_hand", [](NamedLab& lab, const Doubles& target) { change(lab, MoveHand{vector_from("target", target)}); })
      .def("release", [](NamedLab& lab) { change(lab, ReleaseHand{}); })
      .def("nail", &nail)
      .def("remove", &remove)
      .def("set_state", &set_state)
      .def("get",
           [](NamedLab& lab, const std::string& name) {
             const Parameter& parameter = parameter_of("lab", name);
             const Use use(lab);
             return value_of(lab.lab.scene(), parameter);
           })
      .def("set", &set)
      .def("set_integrator", [](NamedLab& lab, const std::string& id) { change(lab, SetIntegrator{&parse_integrator(id)}); })
      .def("undo", [](NamedLab& lab) { change(lab, Undo{}); })
      .def("redo", [](NamedLab& lab) { change(lab, Redo{}); })
      .def("go_to_start", [](NamedLab& lab) { change(lab, GoToStart{}); })
      .def("record", &record)
      .def("stop_recording", [](NamedLab& lab) { change(lab, Record{}); })
      .def("history", &history_of)
      .def("scene",
           [](NamedLab& lab) {
             const Use use(lab);
             return NamedScene{lab.name, {lab.lab.scene(), {}}, lab.functions};
           })
      .def("diagnosis", &diagnosis_of)
      .def("energy", &energy_of)
      .def("loads", &loads_of)
      .def("contacts", &contacts_of)
      .def_property_readonly("accuracy", [](const NamedLab& lab) { return lab.accuracy; })
      .def_property_readonly("execution", [](const NamedLab& lab) { return py::make_tuple(lab.threads, lab.precision, lab.device); })
      .def("energy_balance", &energy_balance_of)
      .def("error", &error_of)
      .def_property_readonly("time",
                             [](NamedLab& lab) {
                               const Use use(lab);
                               return lab.lab.scene().state.time;
                             })
      .def_property_readonly("hash",
                             [](NamedLab& lab) {
                               const Use use(lab);
                               return to_hexadecimal(hash_state(lab.lab.scene().state));
                             })
      .def_property_readonly("positions", [](NamedLab& lab) { return array_of(lab, &NamedLab::positions, &State::position); })
      .def_property_readonly("velocities", [](NamedLab& lab) { return array_of(lab, &NamedLab::velocities, &State::velocity); });

  module.def("replay", &replay);
}

}  // namespace hooke::python
