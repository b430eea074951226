#include "formats/scene_json/scene_fields.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/errors.h"
#include "base/json_writer.h"

namespace hooke {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr std::size_t max_unknown_names = 20;  // that are listed individually in warnings

}  // namespace

std::optional<JsonField> find_member(const JsonField& field, std::string_view key) {
  for (const JsonField member : field.members())
    if (member.is(key)) return member;
  return std::nullopt;
}

JsonField required(const JsonField& field, std::string_view key, std::string_view limit) {
  if (const auto member = find_member(field, key)) return *member;
  field.refuse_missing(key, limit);
}

Vec3 SceneFields::vector(const JsonField& field, bool in_plane) {
  Vec3 vector(0.0);
  const auto items = field.items(2, 3);
  for (std::size_t c = 0; c < items.size(); ++c) vector[static_cast<int>(c)] = items[c].number();
  if (items.size() == 2 && vector_2d_error_.empty()) vector_2d_error_ = field.error_text("must have 3 numbers in a 3-D scene");
  if (in_plane && vector.z != 0.0 && nonzero_z_error_.empty()) nonzero_z_error_ = field.error_text("must have z = 0 in a 2-D scene");
  return vector;
}

void SceneFields::check_dimensions(int dimensions) const {
  const std::string& error_text = dimensions == 2 ? nonzero_z_error_ : vector_2d_error_;
  if (!error_text.empty()) throw InputError(error_text);
}

Vec3 SceneFields::direction(const JsonField& field) {
  constexpr double round_off = 1e-15;
  const Vec3 v = vector(field);
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0.0) field.refuse("must not be zero");
  if (std::abs(glm::length(v) - 1.0) < round_off) return v;
  const Vec3 scaled = v / largest;
  return scaled / glm::length(scaled);
}

Color SceneFields::color(const JsonField& field) const {
  const std::string_view text = field.text();
  int digits[6] = {};
  bool is_valid = text.size() == 7 && text[0] == '#';
  for (std::size_t i = 0; is_valid && i < 6; ++i) {
    digits[i] = hex_digit(text[i + 1]);
    is_valid = digits[i] >= 0;
  }
  if (!is_valid) field.refuse("must be a color \"#rrggbb\"");
  const auto channel = [&](int i) { return static_cast<std::uint8_t>(16 * digits[i] + digits[i + 1]); };
  return {channel(0), channel(2), channel(4)};
}

void SceneFields::preserve_unknown(const JsonField& field, std::string& members, std::string_view text) {
  Unknown& unknown = unknown_keys_[std::string(field.key())];
  if (unknown.count++ == 0) unknown.first = field.path();
  if (!members.empty()) members += ", ";
  members += to_json(field.key()) + ": " + (text.empty() ? to_json(field.value()) : std::string(text));
}

std::vector<std::string> SceneFields::warnings(const std::string& file) const {
  std::vector<std::string> lines;
  for (const auto& [key, unknown] : unknown_keys_) {
    if (lines.size() == max_unknown_names) {
      lines.push_back(file + ": and " + std::to_string(unknown_keys_.size() - max_unknown_names) + " more unknown keys, kept");
      break;
    }
    lines.push_back(file + ": " + unknown.first + ": unknown key, kept" +
                    (unknown.count > 1 ? " (" + std::to_string(unknown.count) + " times)" : ""));
  }
  for (const std::string& warning : warnings_) lines.push_back(file + ": " + warning);
  return lines;
}

}  // namespace hooke
