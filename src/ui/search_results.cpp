#include "ui/search_results.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/printable.h"
#include "formats/scene_file.h"
#include "scene/flatness.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/methods/integrator.h"
#include "ui/number_field.h"
#include "ui/panels/mixed_values.h"
#include "ui/text.h"
#include "ui/typed_field.h"

namespace hooke {
namespace {

std::string plain(std::string_view text) {
  std::string low;
  for (const char c : text)
    if (c != '-') low += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return low;
}

// "friction 0.5" as "friction" and 0.5; without a number the second part is empty.
struct NameAndNumber {
  std::string name;
  std::optional<double> number;
};
NameAndNumber split(const std::string& typed) {
  const std::size_t end = typed.find_last_not_of(' ');
  if (end == std::string::npos) return {typed, {}};
  const std::size_t space = typed.find_last_of(" =", end);
  if (space == std::string::npos) return {typed, {}};
  const auto number = number_typed(std::string_view(typed).substr(space + 1, end - space));
  std::string name = typed.substr(0, space);
  std::ranges::replace(name, '=', ' ');
  return number ? NameAndNumber{name, number} : NameAndNumber{typed, {}};
}

std::string value_text(const Parameter& row, double value) {
  return value == 0.0 && !row.zero_text.empty() ? std::string(row.zero_text) : with_unit(value, row.unit);
}

class ResultFinder {
 public:
  ResultFinder(const PanelInput& input, const std::string& typed) : input_(input), typed_(typed), parts_(split(typed)) {}

  std::vector<SearchResult> results() {
    for (const ActionRow& row : actions()) add_action(row);
    // without a search text, only commands: other results would hide them
    if (typed_.find_first_not_of(' ') != std::string::npos) {
      for (const ShippedScene& scene : shipped_scenes()) add_scene(scene);
      const auto rows = parameters();
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (const double value = input_.status.document->parameter_values[i]; !std::isnan(value)) add_parameter(rows[i], value);
      for (const ShapeKind& kind : placeable_shapes()) add_shape(std::string(kind.label), &kind);
      add_shape("From a mesh", nullptr);
      for (const ColliderKind& kind : collider_kinds())
        add("Add " + std::string(kind.label), "collider", {StartPlacement{nullptr, false, &kind}}, "obstacle");
      add("Use method " + std::string(automatic_method().label), "method tolerance auto", {Edit{SetIntegrator{&automatic_method()}}});
      for (const Integrator& method : integrators())
        add("Use method " + std::string(method.label), "method", {Edit{SetIntegrator{&method}}});
    }
    std::ranges::stable_sort(found_, std::ranges::greater(), &SearchResult::score);
    return std::move(found_);
  }

 private:
  // `also`: words that find it but are not shown.
  void add(const std::string& text, const std::string& remark, Requests requests, const std::string& also = {}) {
    // "cloth" begins the name of what "Open Cloth on a ball" opens
    const bool has_verb = text.starts_with("Open ") || text.starts_with("Add ");
    const std::string more = " " + remark + " " + also, named = has_verb ? text.substr(text.find(' ') + 1) : text;
    if (const int score = std::max(match(text + more, typed_), match(named + more, typed_)); score > 0)
      found_.push_back({text, remark, std::move(requests), {}, score});
  }

  void add_action(const ActionRow& row) {
    if (const int score = match(std::string(row.text) + " " + std::string(row.group), typed_); score > 0)
      found_.push_back({std::string(row.text), key_text(row.keys.chords[0]), {row.action}, {}, score});
  }

  void add_scene(const ShippedScene& scene) {
    add("Open " + printable(scene.title), "scene", {OpenFile{scene.file}}, std::string(scene.group));
  }

  void add_shape(const std::string& label, const ShapeKind* kind) {
    add("Add " + label, "part",
        {StartPlacement{kind, input_.status.snapshot->system->dimensions == 2 && (kind == nullptr || kind->is_3d_only)}},
        kind != nullptr ? std::string(kind->description) : "cloth obj");
  }

  void add_parameter(const Parameter& row, double value) {
    const std::string label(row.label);
    switch (row.kind) {
      case Parameter::Kind::Switch:
        return add("Switch " + label + (value != 0.0 ? " off" : " on"), "parameter", {Edit{SetParameter{&row, value != 0.0 ? 0.0 : 1.0}}});
      case Parameter::Kind::Choice:
        for (std::size_t i = 0; i < row.choices.size(); ++i) {
          if (static_cast<double>(i) == value) continue;
          if (&row == &dimensions_parameter && i == 0 &&
              !why_not_flat(*input_.status.snapshot->system, input_.status.snapshot->state).empty())
            continue;
          add("Set " + label + " to " + std::string(row.choices[i].label), "parameter", {Edit{SetParameter{&row, static_cast<double>(i)}}});
        }
        return;
      case Parameter::Kind::Number:
      case Parameter::Kind::Integer:
        return add_number(row, value);
    }
  }

  // With a number the row sets it; without, it shows the value and waits for a number.
  void add_number(const Parameter& row, double value) {
    const std::string label(row.label);
    const int score = match(label + " " + std::string(row.name) + " parameter", parts_.name);
    if (score == 0) return;
    if (has_many_values(row) && has_no_values(row)) {
      const char* what = row.scope == Parameter::Scope::Colliders ? "collider" : "spring";
      found_.push_back({label + ": the scene has no " + what, "parameter", {}, {}, score});
      return;
    }
    const std::string range = bounds_text(allowed_range(row), row.unit);
    if (!parts_.number) {
      found_.push_back({label + ": " + value_text(row, value), range, {}, label + " ", score});
      return;
    }
    const double set = clamp_to_range(row, *parts_.number);
    found_.push_back({"Set " + label + " to " + value_text(row, set), range, {Edit{SetParameter{&row, set}}}, {}, score + 2});
  }

  bool has_no_values(const Parameter& row) const {
    return values_of(row, *input_.status.snapshot->system, input_.status.document->sheet.get(), {}).is_empty();
  }

  const PanelInput& input_;
  const std::string& typed_;
  NameAndNumber parts_;
  std::vector<SearchResult> found_;
};

}  // namespace

int match(std::string_view text, std::string_view typed) {
  const std::string all = plain(text);
  std::istringstream words(plain(typed));
  int score = 1;
  for (std::string word; words >> word;) {
    const std::size_t at = all.find(word);
    if (at == std::string::npos) return 0;
    if (at == 0) score += 2;
    if (at > 0 && all[at - 1] == ' ') score += 1;
  }
  return score;
}

std::vector<SearchResult> find_results(const PanelInput& input, const std::string& typed) { return ResultFinder(input, typed).results(); }

}  // namespace hooke
