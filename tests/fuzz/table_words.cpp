#include "fuzz/table_words.h"

#include <set>

#include "edit/field_names.h"
#include "scene/parameters.h"
#include "scene/shape.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

std::vector<std::string> in_quotes(const std::set<std::string_view>& words) {
  std::vector<std::string> quoted;
  for (const std::string_view word : words) quoted.push_back('"' + std::string(word) + '"');
  return quoted;
}

template <class T>
void add_command(std::set<std::string_view>& words) {
  words.insert(T::name);
  words.insert(field_names<T>.begin(), field_names<T>.end());
}

template <std::size_t... i>
std::set<std::string_view> words_of_commands(std::index_sequence<i...>) {
  std::set<std::string_view> words;
  (add_command<std::variant_alternative_t<i, CommandVariant>>(words), ...);
  return words;
}

}  // namespace

std::vector<std::string> scene_table_words() {
  std::set<std::string_view> words;
  for (const Parameter& row : parameters()) {
    if (!row.field.empty()) words.insert(row.field.substr(row.field.rfind('.') + 1));
    for (const ParameterChoice& choice : row.choices) words.insert(choice.id);
  }
  for (const ShapeKind& kind : shape_kinds()) {
    words.insert(kind.id);
    for (const ShapeNumber& number : kind.numbers) {
      words.insert(number.name);
      words.insert(number.choices.begin(), number.choices.end());
    }
    for (const ShapeVector& vector : kind.vectors) words.insert(vector.name);
    for (const NailKeyword& keyword : kind.nail_keywords) words.insert(keyword.word);
    words.insert(kind.supports.begin(), kind.supports.end());
  }
  for (const ForceTerm& term : force_terms()) {
    words.insert(term.id);
    for (const ForceParameter& number : term.numbers) {
      words.insert(number.name);
      for (const ForceChoice& choice : number.choices) words.insert(choice.id);
    }
  }
  for (const Integrator& method : integrators()) words.insert(method.id);
  return in_quotes(words);
}

std::vector<std::string> recording_table_words() {
  return in_quotes(words_of_commands(std::make_index_sequence<std::variant_size_v<CommandVariant>>()));
}

}  // namespace hooke
