#include "python/scene_binding.h"

#include <pybind11/stl.h>

#include <glm/geometric.hpp>

#include "base/file_limits.h"
#include "base/printable.h"
#include "batch/run_report.h"
#include "edit/append_parts.h"
#include "edit/command.h"
#include "formats/open_file.h"
#include "formats/scene_json/spring_law_fields.h"
#include "scene/parameters.h"
#include "scene/spring_laws.h"
#include "sim/forces/bands.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"

namespace hooke::python {
namespace {

void change(NamedScene& scene, const Command& command) {
  Effect effect;
  apply(scene.scene(), command, effect);
}

const std::vector<Point>& points_of(const NamedScene& scene) { return scene.scene().system.points(); }
const SpringList& springs_of(const NamedScene& scene) { return scene.scene().system.springs(); }

std::string at(const std::string& name, std::size_t index) { return name + "[" + std::to_string(index) + "]"; }

NamedScene load(const std::string& name, const std::map<std::string, std::string>& options) {
  LoadedScene loaded = load_file(find_scene(name), {}, to_import_options(options));
  return {name, loaded, {}, loaded.warnings};
}

NamedScene parse(const std::string& text, const std::string& name) { return {name, parse_scene(text, name)}; }

// The members of a scene file that list parts: "generators": [...], "colliders": [...].
void add_part(NamedScene& scene, const std::string& members, const std::string& name) { add_members(scene.scene(), members, name); }

Index add_points(NamedScene& scene, const Doubles& positions, const Doubles& masses, const Doubles& velocities, const Doubles& radii,
                 const std::vector<bool>& nailed) {
  const std::size_t count = positions.ndim() > 0 ? static_cast<std::size_t>(positions.shape(0)) : 0;
  const std::vector<Vec3> position = flat_vectors(scene.scene().system, "positions", positions, count);
  const std::vector<Vec3> velocity = flat_vectors(scene.scene().system, "velocity", velocities, count);
  const std::vector<double> mass = to_values("mass", masses, count), radius = to_values("radius", radii, count);
  if (points_of(scene).size() + count > max_points)
    throw InputError("points: " + std::to_string(points_of(scene).size() + count) + ": must be at most " + std::to_string(max_points));
  Insert insert;
  const Index first = scene.scene().system.point_count();
  for (std::size_t i = 0; i < count; ++i) {
    check_value(at("mass", i), mass[i], positive);
    check_value(at("radius", i), radius[i], not_negative);
    const Point point{.id = scene.scene().system.new_point_id(), .nailed = nailed[i], .mass = mass[i], .radius = radius[i]};
    insert.points.push_back({.point = point, .position = position[i], .velocity = velocity[i]});
  }
  change(scene, insert);
  return first;
}

Index add_springs(NamedScene& scene, const Integers& ends, const Doubles& stiffnesses, const Doubles& dampings,
                  const py::object& rest_lengths, const py::object& break_strains) {
  if (ends.ndim() != 2 || ends.shape(1) != 2) throw InputError("points: shape " + shape_of(ends) + ": must be (springs, 2)");
  const auto count = static_cast<std::size_t>(ends.shape(0));
  const std::vector<double> stiffness = to_values("stiffness", stiffnesses, count), damping = to_values("damping", dampings, count);
  const auto optional_values = [&](const char* name, const py::object& values) {
    return values.is_none() ? std::vector<double>() : to_values(name, values.cast<Doubles>(), count);
  };
  const std::vector<double> rest_length = optional_values("rest_length", rest_lengths);
  const std::vector<double> break_strain = optional_values("break_strain", break_strains);
  if (springs_of(scene).size() + count > max_springs)
    throw InputError("springs: " + std::to_string(springs_of(scene).size() + count) + ": must be at most " + std::to_string(max_springs));
  const Index first = scene.scene().system.spring_count();
  Insert insert;
  const State& state = scene.scene().state;
  for (std::size_t s = 0; s < count; ++s) {
    const std::int64_t i = *ends.data(static_cast<py::ssize_t>(s), 0), j = *ends.data(static_cast<py::ssize_t>(s), 1);
    for (const std::int64_t end : {i, j})
      if (end < 0 || end >= scene.scene().system.point_count())
        throw InputError(at("points", s) + ": " + std::to_string(end) + ": must be the number of one of the " +
                         std::to_string(points_of(scene).size()) + " points, from 0");
    if (i == j) throw InputError(at("points", s) + ": must be two different points");
    check_value(at("stiffness", s), stiffness[s], not_negative);
    check_value(at("damping", s), damping[s], not_negative);
    const Vec3 apart = state.position[static_cast<std::size_t>(j)] - state.position[static_cast<std::size_t>(i)];
    // as drawn, with the formula that reads files
    Spring spring{.id = scene.scene().system.new_spring_id(),
                  .first = points_of(scene)[static_cast<std::size_t>(i)].id,
                  .second = points_of(scene)[static_cast<std::size_t>(j)].id,
                  .stiffness = stiffness[s],
                  .damping = damping[s],
                  .rest_length = rest_length.empty() ? glm::length(apart) : rest_length[s]};
    check_value(at("rest_length", s), spring.rest_length, not_negative);
    if (!break_strain.empty()) {
      if (!(break_strain[s] > 0.0)) check_value(at("break_strain", s), break_strain[s], positive);
      spring.break_strain = break_strain[s];
    }
    insert.springs.push_back({.spring = spring});
  }
  change(scene, insert);
  return first;
}

template <class Item, class Value>
py::array column(const std::vector<Item>& items, const std::function<Value(const Item&)>& read) {
  py::array_t<Value> array(static_cast<py::ssize_t>(items.size()));
  Value* to = array.mutable_data();
  for (const Item& item : items) *to++ = read(item);
  return read_only(array);
}

void set_motion(NamedScene& scene, const std::vector<Vec3>& position, const std::vector<Vec3>& velocity) {
  Move move;
  for (std::size_t i = 0; i < position.size(); ++i) move.items.push_back({points_of(scene)[i].id, position[i], velocity[i]});
  change(scene, move);
}

void set_positions(NamedScene& scene, const Doubles& array) {
  set_motion(scene, flat_vectors(scene.scene().system, "positions", array, points_of(scene).size()), scene.scene().state.velocity);
}

void set_velocities(NamedScene& scene, const Doubles& array) {
  set_motion(scene, scene.scene().state.position, flat_vectors(scene.scene().system, "velocities", array, points_of(scene).size()));
}

void set_nailed(NamedScene& scene, const std::vector<bool>& nailed) {
  if (nailed.size() != points_of(scene).size())
    throw InputError("nailed: " + std::to_string(nailed.size()) + " values: must be " + std::to_string(points_of(scene).size()));
  SetNailed set;
  for (std::size_t i = 0; i < nailed.size(); ++i)
    if (points_of(scene)[i].nailed != nailed[i]) set.items.push_back({points_of(scene)[i].id, nailed[i]});
  change(scene, set);
}

py::array point_loads(const NamedScene& scene) {
  std::vector<Vec3> loads;
  for (const Point& point : points_of(scene)) loads.push_back(point.load);
  return read_only(to_array(loads));
}

void set_loads(NamedScene& scene, const Doubles& array) {
  const std::vector<Vec3> loads = flat_vectors(scene.scene().system, "loads", array, points_of(scene).size());
  SetLoad set;
  for (std::size_t i = 0; i < loads.size(); ++i) set.values.emplace_back(points_of(scene)[i].id, loads[i]);
  change(scene, set);
}

std::vector<std::string> fixed_axes_of(const NamedScene& scene) {
  std::vector<std::string> texts;
  for (const Point& point : points_of(scene)) texts.push_back(axes_text(point.fixed_axes));
  return texts;
}

void set_fixed_axes(NamedScene& scene, const std::vector<std::string>& texts) {
  if (texts.size() != points_of(scene).size())
    throw InputError("fixed: " + std::to_string(texts.size()) + " values: must be " + std::to_string(points_of(scene).size()));
  SetFixedAxes set;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto axes = axes_of(texts[i]);
    if (!axes) throw InputError(at("fixed", i) + ": " + printable(texts[i], 80) + ": must be axes in their order, as \"y\" or \"xz\"");
    set.values.emplace_back(points_of(scene)[i].id, *axes);
  }
  change(scene, set);
}

// SetPointProperty or SetSpringProperty of all.
template <class Set, class Items>
void set_all(NamedScene& scene, Set set, const Items& items, const std::string& name, const Bounds& bounds, const Doubles& array) {
  const std::vector<double> values = to_values(name, array, items.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    check_value(at(name, i), values[i], bounds);
    set.values.emplace_back(items[i].id, values[i]);
  }
  change(scene, set);
}

// The numbers of the points of each spring or face, `points_of_each` of it.
template <class Items, class Read>
py::array numbers_of(const System& system, const Items& items, py::ssize_t columns, Read points_of_each) {
  py::array_t<std::int64_t> array({static_cast<py::ssize_t>(items.size()), columns});
  std::int64_t* to = array.mutable_data();
  for (const auto& item : items)
    for (const PointId point : points_of_each(item)) *to++ = system.index_of(point);
  return read_only(array);
}

std::vector<std::string> save(const NamedScene& scene, const std::string& file) {
  if (has_force_callback(scene.scene())) throw InputError(file + ": forces: a Python function cannot be written to a file");
  return write_scene_as(scene.scene(), file);
}

// The members of each law as in scene files; none: it has no law.
using LawTexts = std::vector<std::optional<std::string>>;

LawTexts laws_of(const NamedScene& scene) {
  LawTexts texts;
  for (const Spring& spring : springs_of(scene)) {
    JsonWriter out;
    out.begin_object(JsonWriter::Layout::Line);
    if (spring.law) write_law(*spring.law, out);
    out.end();
    texts.push_back(spring.law ? std::optional(out.take()) : std::nullopt);
  }
  return texts;
}

void set_laws(NamedScene& scene, const LawTexts& texts) {
  const SpringList& springs = springs_of(scene);
  if (texts.size() != springs.size())
    throw InputError("laws: " + std::to_string(texts.size()) + " values: must be " + std::to_string(springs.size()));
  SetSpringLaw set;
  for (std::size_t s = 0; s < texts.size(); ++s) {
    Spring spring = springs[s];
    spring.law.reset();
    if (texts[s]) {
      JsonParser parser;
      const JsonField law(scene.name, "laws", parser.parse(*texts[s]), s);
      for (const JsonField member : law.members())
        if (!read_law_field(member, spring)) member.refuse("must be a field of a law");
    }
    if (const LawError error = error_of(spring); !error.limit.empty())
      throw InputError(at("laws", s) + "." + std::string(error.field) + ": " + error.limit);
    set.values.emplace_back(spring.id, spring.law);
  }
  change(scene, set);
}

NamedScene with_options(const NamedScene& scene, const std::optional<std::string>& integrator, std::optional<std::int64_t> substeps,
                        std::optional<double> frame_rate, std::optional<double> tolerance) {
  const SteppingOptions options{
      .integrator = integrator, .substeps = substeps, .frame_rate = frame_rate, .tolerance = tolerance, .settings = {}};
  NamedScene copy = scene;
  copy.checked.reset();
  if (scene.checked && scene.checked->options == options) {
    set_options(copy.loaded.scene, options, copy.name);
    copy.loaded.warnings = scene.checked->warnings;
  } else {
    apply_options(copy.loaded, options, copy.name);
    scene.checked = {options, copy.loaded.warnings};
  }
  return copy;
}

// Calls `parse`, and names scene["NAME"] in its errors.
template <class Parse>
auto parse_item(const char* owner, const std::string& name, const std::string& value, Parse parse) {
  try {
    return parse();
  } catch (const OptionError& error) {
    const std::string shown = value.empty() ? "" : printable(value, 80) + ": ";
    throw UsageError(std::string(owner) + "[\"" + printable(name, 80) + "\"]: " + shown + error.reason());
  }
}

// Arrays with a value for each point or spring.
void bind_columns(py::class_<NamedScene>& scene_class) {
  const auto point_column = [](auto member) {
    return [member](const NamedScene& scene) {
      return column<Point, double>(points_of(scene), [member](const Point& point) { return point.*member; });
    };
  };
  const auto spring_column = [](auto member) {
    return [member](const NamedScene& scene) {
      return column<Spring, double>(springs_of(scene), [member](const Spring& spring) { return spring.*member; });
    };
  };
  const auto point_setter = [](PointProperty property, const char* name, Bounds bounds) {
    return [=](NamedScene& scene, const Doubles& array) {
      set_all(scene, SetPointProperty{.property = property, .values = {}}, points_of(scene), name, bounds, array);
    };
  };
  const auto spring_setter = [](SpringProperty property, const char* name) {
    return [=](NamedScene& scene, const Doubles& array) {
      set_all(scene, SetSpringProperty{.property = property, .values = {}}, springs_of(scene), name, not_negative, array);
    };
  };
  scene_class.def_property("loads", &point_loads, &set_loads)
      .def_property("fixed", &fixed_axes_of, &set_fixed_axes)
      .def_property("masses", point_column(&Point::mass), point_setter(PointProperty::Mass, "masses", positive))
      .def_property("radii", point_column(&Point::radius), point_setter(PointProperty::Radius, "radii", not_negative))
      .def_property("stiffness", spring_column(&Spring::stiffness), spring_setter(SpringProperty::Stiffness, "stiffness"))
      .def_property("damping", spring_column(&Spring::damping), spring_setter(SpringProperty::Damping, "damping"))
      .def_property("rest_length", spring_column(&Spring::rest_length), spring_setter(SpringProperty::RestLength, "rest_length"))
      .def_property("laws", &laws_of, &set_laws)
      .def_property_readonly("springs",
                             [](const NamedScene& scene) {
                               return numbers_of(scene.scene().system, springs_of(scene), 2, [](const Spring& spring) {
                                 return std::array{spring.first, spring.second};
                               });
                             })
      .def_property_readonly("faces", [](const NamedScene& scene) {
        const System& system = scene.scene().system;
        return numbers_of(system, system.faces, 3, [](const Face& face) { return face.points; });
      });
}

}  // namespace

ImportOptions to_import_options(const std::map<std::string, std::string>& texts) {
  ImportOptions options;
  for (const ImportOption& row : import_options())
    if (const auto text = texts.find(std::string(row.name)); text != texts.end()) row.set(options, text->second);
  return options;
}

std::vector<Vec3> flat_vectors(const System& system, const std::string& name, const Doubles& array, std::size_t count) {
  std::vector<Vec3> vectors = to_vectors(name, array, count);
  for (std::size_t i = 0; system.dimensions == 2 && i < count; ++i)
    if (vectors[i].z != 0.0) throw InputError(at(name, i) + ": z = " + format_exact(vectors[i].z) + ": must be 0 in a 2-D scene");
  return vectors;
}

const Parameter& parameter_of(const char* owner, const std::string& name) {
  try {
    return *parse_item(owner, name, "", [&] { return &parse_parameter(name); });
  } catch (const UsageError& error) {
    throw UnknownName(error.what());
  }
}

Execution execution_of(const Lab& lab, std::int64_t threads, const std::string& precision, const std::string& device) {
  check_option("threads", static_cast<double>(threads), {.min = 1, .max = max_parts});
  const bool is_single = precision == "single";
  if (!is_single && precision != "double") throw OptionError("precision", printable(precision, 80), "must be double or single");
  if (device != "cpu" && device != "gpu") throw OptionError("device", printable(device, 80), "must be cpu or gpu");
  return make_execution(lab, {.threads = static_cast<int>(threads),
                              .precision = is_single ? Precision::Single : Precision::Double,
                              .device = device == "gpu" ? Device::Gpu : Device::Cpu});
}

SetParameter setting_of(const char* owner, const std::string& name, const std::string& value) {
  parameter_of(owner, name);
  return parse_item(owner, name, value, [&] { return parse_setting(name, value); });
}

py::object value_of(const Scene& scene, const Parameter& parameter) {
  const double value = parameter.read(scene);
  switch (parameter.kind) {
    case Parameter::Kind::Switch:
      return py::bool_(value != 0.0);
    case Parameter::Kind::Choice:
      if (&parameter == &dimensions_parameter) return py::int_(scene.system.dimensions);
      return py::str(std::string(parameter.choices[static_cast<std::size_t>(value)].id));
    case Parameter::Kind::Integer:
      return py::int_(static_cast<long>(value));
    case Parameter::Kind::Number:
      break;
  }
  return py::float_(value);
}

void bind_scene(py::module_& module) {
  py::class_<NamedScene> scene(module, "Scene");
  bind_columns(scene);
  scene.def_static("load", &load)
      .def_static("parse", &parse)
      .def("copy", [](const NamedScene& scene) { return scene; })
      .def("with_options", &with_options)
      .def("json",
           [](const NamedScene& scene) {
             if (has_force_callback(scene.scene())) throw InputError("forces: a Python function cannot be written to a file");
             return format_scene(scene.scene());
           })
      .def("save", &save)
      .def("add", &add_part)
      .def("add_points", &add_points)
      .def("add_springs", &add_springs)
      .def("add_force", [](NamedScene& scene,
                           py::function function) { scene.functions.push_back(add_force_callback(scene.scene(), std::move(function))); })
      .def("get", [](const NamedScene& scene, const std::string& name) { return value_of(scene.scene(), parameter_of("scene", name)); })
      .def("set", [](NamedScene& scene, const std::string& name,
                     const std::string& value) { apply_setting(scene.scene(), setting_of("scene", name, value), scene.name); })
      .def_property_readonly("name", [](const NamedScene& scene) { return py::bytes(scene.name); })
      .def_property_readonly("title", [](const NamedScene& scene) { return scene.scene().name; })
      .def_property_readonly("description", [](const NamedScene& scene) { return scene.scene().description; })
      .def_property_readonly("warnings", [](const NamedScene& scene) { return scene.loaded.warnings; })
      .def_property_readonly("told", [](const NamedScene& scene) { return scene.told; })
      .def_property_readonly("summary", [](const NamedScene& scene) { return scene.loaded.summary; })
      .def_property_readonly("dimensions", [](const NamedScene& scene) { return scene.scene().system.dimensions; })
      .def_property_readonly("time", [](const NamedScene& scene) { return scene.scene().state.time; })
      .def_property_readonly("integrator", [](const NamedScene& scene) { return std::string(scene.scene().settings.integrator->id); })
      .def_property_readonly("frame_rate", [](const NamedScene& scene) { return scene.scene().settings.frame_rate; })
      .def_property_readonly("substeps", [](const NamedScene& scene) { return scene.scene().settings.substeps; })
      .def_property_readonly("tolerance", [](const NamedScene& scene) { return scene.scene().settings.tolerance; })
      .def_property_readonly("hash", [](const NamedScene& scene) { return to_hexadecimal(hash_state(scene.scene().state)); })
      .def_property(
          "positions", [](const NamedScene& scene) { return read_only(to_array(scene.scene().state.position)); }, &set_positions)
      .def_property(
          "velocities", [](const NamedScene& scene) { return read_only(to_array(scene.scene().state.velocity)); }, &set_velocities)
      .def_property(
          "nailed",
          [](const NamedScene& scene) { return column<Point, bool>(points_of(scene), [](const Point& point) { return point.nailed; }); },
          &set_nailed);
}

}  // namespace hooke::python
