#include "python/lab_binding.h"

#include <pybind11/stl.h>

#include "base/finite.h"
#include "batch/run_report.h"
#include "formats/open_file.h"
#include "lab/recording.h"
#include "sim/hash.h"

namespace hooke::python {
namespace {

void submit(NamedLab& lab, Command command) {
  lab.lab->submit(std::move(command));
  lab.lab->apply_pending();
}

void control(NamedLab& lab, Control control) {
  lab.lab->submit(std::move(control));
  lab.lab->apply_pending();
}

PointId id_of(const NamedLab& lab, std::int64_t point) {
  const System& system = lab.lab->scene().system;
  if (point < 0 || point >= system.point_count())
    throw InputError("point: " + std::to_string(point) + ": must be the number of one of the " + std::to_string(system.point_count()) +
                     " points, from 0");
  return system.points()[static_cast<std::size_t>(point)].id;
}

Vec3 vector_from(const std::string& name, const std::array<double, 3>& values) {
  const Vec3 vector(values[0], values[1], values[2]);
  if (!is_finite(vector)) throw InputError(name + ": must be numbers below 1.8e308");
  return vector;
}

// False: the run diverged, and the state is that of the last valid frame.
bool step(NamedLab& lab, long frames, py::object progress) {
  Watch watch(std::move(progress));
  const py::gil_scoped_release unlocked;
  for (long frame = 0; frame < frames; ++frame) {
    const bool is_valid = lab.lab->step();
    watch.check(frame + 1, frames);
    if (!is_valid) return false;
  }
  return true;
}

void grab(NamedLab& lab, std::int64_t point, const std::array<double, 3>& target, std::optional<double> pull) {
  if (pull) check_option("pull", *pull, not_negative);
  GrabPoint::Item item{.point = id_of(lab, point), .kind = pull ? GrabKind::Pull : GrabKind::Hold, .target = vector_from("target", target)};
  if (pull) item.stiffness = *pull;
  submit(lab, GrabPoint{item});
}

void nail(NamedLab& lab, const std::vector<std::int64_t>& points, bool nailed) {
  SetNailed set;
  for (const std::int64_t point : points) set.items.push_back({id_of(lab, point), nailed});
  submit(lab, set);
}

void set_state(NamedLab& lab, const Doubles& positions, const Doubles& velocities) {
  const Scene& scene = lab.lab->scene();
  const std::size_t count = scene.system.points().size();
  const std::vector<Vec3> position = to_vectors("positions", positions, count), velocity = to_vectors("velocities", velocities, count);
  Move move;
  for (std::size_t i = 0; i < count; ++i) move.items.push_back({scene.system.points()[i].id, position[i], velocity[i]});
  submit(lab, move);
}

py::object diagnosis_of(NamedLab& lab, const NamedScene* start, double seconds) {
  std::string text;
  {
    const py::gil_scoped_release unlocked;
    text = explain_divergence(*lab.lab, start == nullptr ? nullptr : &start->scene(), seconds);
  }
  return text.empty() ? py::object(py::none()) : py::object(py::str(text));
}

}  // namespace

py::dict energy_of(const Lab& lab) {
  const Energy energy = compute_energy(lab.scene().system, lab.scene().state);
  py::dict entry;
  entry["kinetic"] = energy.kinetic;
  entry["elastic"] = energy.elastic;
  entry["gravitational"] = energy.gravitational;
  entry["total"] = energy.total();
  return entry;
}

py::dict error_of(const Accuracy& accuracy) {
  py::dict entry;
  entry["frame"] = accuracy.frame.value;
  entry["frame_max"] = accuracy.frame_max.value;
  entry["accumulated"] = accuracy.accumulated.value;
  entry["amplification"] = accuracy.amplification.value;
  entry["predictable"] = accuracy.predictable.value;
  return entry;
}

void bind_lab(py::module_& module) {
  py::class_<NamedLab>(module, "Lab")
      .def(py::init([](const NamedScene& scene, const std::string& accuracy) {
        NamedLab lab{scene.name, std::make_shared<Lab>(scene.scene())};
        control(lab, SetAccuracy{accuracy == "full" ? AccuracyMode::Full : accuracy == "frame" ? AccuracyMode::Frame : AccuracyMode::Off});
        return lab;
      }))
      .def("step", &step)
      .def("measure_accuracy",
           [](NamedLab& lab) {
             const py::gil_scoped_release unlocked;
             lab.lab->measure_accuracy([] { return true; });
           })
      .def("grab", &grab)
      .def("move_hand", [](NamedLab& lab, const std::array<double, 3>& target) { submit(lab, MoveHand{vector_from("target", target)}); })
      .def("release", [](NamedLab& lab) { submit(lab, ReleaseHand{}); })
      .def("nail", &nail)
      .def("set", [](NamedLab& lab, const std::string& setting) { submit(lab, parse_setting(setting)); })
      .def("set_integrator", [](NamedLab& lab, const std::string& id) { submit(lab, SetIntegrator{&parse_integrator(id)}); })
      .def("remove",
           [](NamedLab& lab, const std::vector<std::int64_t>& points, const std::vector<std::int64_t>& springs) {
             Remove remove;
             for (const std::int64_t point : points) remove.points.push_back(id_of(lab, point));
             const std::vector<Spring>& all = lab.lab->scene().system.springs();
             for (const std::int64_t spring : springs) {
               if (spring < 0 || spring >= std::ssize(all))
                 throw InputError("spring: " + std::to_string(spring) + ": must be less than " + std::to_string(all.size()));
               remove.springs.push_back(all[static_cast<std::size_t>(spring)].id);
             }
             submit(lab, remove);
           })
      .def("set_state", &set_state)
      .def("undo", [](NamedLab& lab) { control(lab, Undo{}); })
      .def("redo", [](NamedLab& lab) { control(lab, Redo{}); })
      .def("go_to_start", [](NamedLab& lab) { control(lab, GoToStart{}); })
      .def("record",
           [](NamedLab& lab, const std::string& file) {
             control(lab, Record{std::make_shared<const std::filesystem::path>(file)});
             lab.lab->publish();
             if (const std::string& error = lab.lab->status()->recording.error; !error.empty()) throw FileError(error);
           })
      .def("stop_recording", [](NamedLab& lab) { control(lab, Record{}); })
      .def("history",
           [](const NamedLab& lab) {
             lab.lab->publish();
             return std::pair(lab.lab->status()->history.undo_name, lab.lab->status()->history.redo_name);
           })
      .def("scene",
           [](const NamedLab& lab) {
             return NamedScene{lab.name, {lab.lab->scene(), {}}};
           })
      .def("diagnosis", &diagnosis_of)
      .def("energy", [](const NamedLab& lab) { return energy_of(*lab.lab); })
      .def("error", [](const NamedLab& lab) { return error_of(lab.lab->accuracy()); })
      .def_property_readonly("time", [](const NamedLab& lab) { return lab.lab->scene().state.time; })
      .def_property_readonly("hash", [](const NamedLab& lab) { return to_hexadecimal(hash_state(lab.lab->scene().state)); })
      .def_property_readonly("positions", [](const NamedLab& lab) { return to_array(lab.lab->scene().state.position); })
      .def_property_readonly("velocities", [](const NamedLab& lab) { return to_array(lab.lab->scene().state.velocity); });

  module.def("replay", [](const std::string& file, py::object progress) {
    const auto recording = std::make_shared<const Recording>(read_recording(file));
    Lab lab(*recording->start, KeepStart::No);
    lab.submit(Play{recording});
    Watch watch(std::move(progress));
    long frames = 0;
    {
      const py::gil_scoped_release unlocked;
      lab.advance(0.0, [] { return true; });
      while (lab.is_playing()) {
        lab.step();
        watch.check(++frames, recording->frames);
      }
    }
    return py::make_tuple(frames, to_hexadecimal(hash_state(lab.scene().state)), lab.difference());
  });
}

}  // namespace hooke::python
