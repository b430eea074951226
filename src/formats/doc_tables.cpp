#include "formats/doc_tables.h"

#include "base/text_lines.h"
#include "formats/file_kind.h"
#include "scene/parameters.h"
#include "scene/shape.h"

namespace hooke {
namespace {

std::string code(std::string_view text) { return "`" + std::string(text) + "`"; }

// ---- parameters

std::string default_of(const Parameter& row) {
  if (row.kind == Parameter::Kind::Switch) return row.default_value != 0.0 ? "true" : "false";
  if (row.kind == Parameter::Kind::Choice) return "\"" + std::string(row.choices[static_cast<std::size_t>(row.default_value)].id) + "\"";
  return format_rounded(row.default_value);
}

std::string range_of(const Parameter& row) {
  if (row.kind == Parameter::Kind::Switch) return "";
  if (row.kind == Parameter::Kind::Choice)
    return joined(row.choices, [](const ParameterChoice& choice) { return "\"" + std::string(choice.id) + "\""; });
  constexpr std::string_view prefix = "must be ";
  return row.physical.text().substr(prefix.size());
}

std::string parameter_table() {
  std::string table = "| key | unit | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const Parameter& row : parameters())
    if (!row.field.empty())
      table += "| " + code(row.field) + " | " + std::string(row.unit) + " | " + default_of(row) + " | " + range_of(row) + " | " +
               std::string(row.description) + " |\n";
  return table;
}

// ---- shapes

std::string numbers_of(const ShapeKind& kind) {
  std::string list;
  for (const ShapeNumber& number : kind.numbers) {
    list += (list.empty() ? "" : ", ") + code(number.name) + " " + format_rounded(number.default_value);
    if (!number.unit.empty()) list += " " + std::string(number.unit);
  }
  return list;
}

std::string shape_table() {
  std::string table = "| type | description | parameters: name, default, unit | `held` |\n|---|---|---|---|\n";
  for (const ShapeKind& kind : placeable_shapes()) {
    std::string description(kind.description);
    if (!kind.details.empty()) description += " " + std::string(kind.details) + ".";
    if (kind.is_3d_only) description += " Only in 3-D scenes.";
    table += "| " + code(kind.id) + " | " + description + " | " + numbers_of(kind) + " | " + joined(kind.supports) + " |\n";
  }
  return table;
}

// ---- file formats

std::string format_table() {
  std::string table = "| extension | format | read | written | exported from the window |\n|---|---|---|---|---|\n";
  for (const FileKind& kind : file_kinds()) {
    const char* written = kind.format != nullptr        ? (kind.is_flat_only ? "2-D scenes" : "yes")
                          : kind.open_frames != nullptr ? "over time"
                                                        : "no";
    table += "| " + code(kind.extension) + " | " + std::string(kind.title) + " | " + (kind.parse != nullptr ? "yes" : "no") + " | " +
             written + " | " + std::string(kind.description) + " |\n";
  }
  return table;
}

// ---- shipped scenes

std::string scene_table() {
  std::string table = "| group | scenes |\n|---|---|\n", group;
  for (const ShippedScene& scene : shipped_scenes()) {
    if (scene.group != group)
      table += (group.empty() ? "| " : " |\n| ") + scene.group + " | ";
    else
      table += ", ";
    group = scene.group;
    table += code(scene.id);
  }
  return table + (group.empty() ? "" : " |\n");
}

struct Block {
  std::string_view name;
  std::string (*text)();
};
constexpr Block blocks[] = {{"parameters", parameter_table}, {"shapes", shape_table}, {"formats", format_table}, {"scenes", scene_table}};

}  // namespace

std::string with_table(std::string page, std::string_view name, std::string_view table) {
  const std::string begin_line = "<!-- table " + std::string(name) + " -->\n";
  const std::size_t begin = page.find(begin_line);
  if (begin == std::string::npos) return page;
  const std::size_t first = begin + begin_line.size(), end = page.find("<!-- end -->\n", first);
  if (end != std::string::npos) page.replace(first, end - first, table);
  return page;
}

std::string with_doc_tables(std::string_view page) {
  std::string text(page);
  for (const Block& block : blocks) text = with_table(text, block.name, block.text());
  return text;
}

}  // namespace hooke
