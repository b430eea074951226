// The tables of Hooke as lists of dictionaries: parameters, methods, shapes, forces, quantities.
#include <pybind11/stl.h>

#include <cmath>
#include <functional>

#include "formats/scene_file.h"
#include "python/scene_binding.h"
#include "scene/parameters.h"
#include "scene/quantity.h"
#include "scene/shape.h"
#include "sim/control/automatic.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"

namespace hooke::python {
namespace {

using namespace py::literals;

py::list list_parameters() {
  py::list rows;
  for (const Parameter& row : parameters()) {
    py::list choices;
    const Bounds range = row.is_number() ? allowed_range(row) : Bounds{.min = row.min, .max = row.max};
    for (const ParameterChoice& choice : row.choices) choices.append(py::str(std::string(choice.id)));
    static constexpr const char* kinds[] = {"number", "integer", "switch", "choice"};
    rows.append(py::dict("name"_a = row.name, "unit"_a = row.unit, "description"_a = row.description,
                         "kind"_a = kinds[static_cast<std::size_t>(row.kind)], "min"_a = range.min, "max"_a = range.max,
                         "default"_a = row.default_value, "choices"_a = choices));
  }
  return rows;
}

py::list list_methods() {
  py::list rows;
  const auto add = [&](const Integrator& row) {
    rows.append(py::dict("id"_a = row.id, "label"_a = row.label, "summary"_a = row.summary, "cost"_a = row.cost, "order"_a = row.order,
                         "adaptive"_a = row.stability == Stability::Adaptive));
  };
  for (const Integrator& row : integrators()) add(row);
  add(automatic_method());
  return rows;
}

// (name, unit or words, default), of a shape or a force
template <class Number, class WordOf>
py::tuple field_of(const Number& number, WordOf word_of) {
  const bool has_default = !std::isnan(number.default_value);
  if (number.choices.empty())
    return py::make_tuple(std::string(number.name), std::string(number.unit),
                          has_default ? py::object(py::float_(number.default_value)) : py::none());
  std::string words;
  for (const auto& choice : number.choices) words += (words.empty() ? "" : " | ") + std::string(std::invoke(word_of, choice));
  const auto chosen = [&] { return std::string(std::invoke(word_of, number.choices[static_cast<std::size_t>(number.default_value)])); };
  return py::make_tuple(std::string(number.name), words, has_default ? py::object(py::str(chosen())) : py::none());
}

py::list list_shapes() {
  py::list rows;
  for (const ShapeKind& row : shape_kinds()) {
    py::list fields, nails;
    for (const ShapeVector& vector : row.vectors)
      fields.append(py::make_tuple(std::string(vector.name), std::string(vector.format), py::none()));
    for (const ShapeNumber& number : row.numbers) fields.append(field_of(number, std::identity()));
    for (const NailKeyword& nail : row.nail_keywords) nails.append(std::string(nail.word));
    rows.append(py::dict("id"_a = row.id, "description"_a = row.description, "fields"_a = fields, "nails"_a = nails));
  }
  return rows;
}

py::list list_forces() {
  py::list rows;
  for (const ForceTerm& row : force_terms()) {
    py::list fields;
    for (const ForceParameter& number : row.numbers) fields.append(field_of(number, &ForceChoice::id));
    rows.append(py::dict("id"_a = row.id, "description"_a = row.description, "fields"_a = fields));
  }
  return rows;
}

py::list list_quantities() {
  py::list rows;
  for (const QuantityRow& row : quantity_rows())
    rows.append(py::dict("name"_a = row.name, "unit"_a = row.unit, "description"_a = row.description));
  return rows;
}

py::list list_scenes() {
  py::list rows;
  for (const ShippedScene& row : shipped_scenes())
    rows.append(py::dict("id"_a = row.id, "title"_a = row.title, "group"_a = row.group, "description"_a = row.description));
  return rows;
}

}  // namespace

void bind_tables(py::module_& module) {
  module.def("parameters", &list_parameters);
  module.def("methods", &list_methods);
  module.def("shapes", &list_shapes);
  module.def("forces", &list_forces);
  module.def("quantities", &list_quantities);
  module.def("scenes", &list_scenes);
}

}  // namespace hooke::python
