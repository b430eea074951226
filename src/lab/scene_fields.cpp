#include "lab/scene_fields.h"

#include "lab/json_writer.h"
#include "sim/errors.h"

namespace hooke {
namespace {

int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr std::size_t most_unknown_names = 20;  // that are warned of one by one

}  // namespace

Vec3 SceneFields::vector(const JsonField& field, bool in_plane) {
  Vec3 vector(0.0);
  const auto items = field.items(2, 3);
  for (std::size_t c = 0; c < items.size(); ++c) vector[static_cast<int>(c)] = items[c].number();
  if (items.size() == 2 && flat_vector_.empty()) flat_vector_ = field.complaint("must have 3 numbers in a 3-D scene");
  if (in_plane && vector.z != 0.0 && deep_vector_.empty()) deep_vector_ = field.complaint("must have z = 0 in a 2-D scene");
  return vector;
}

void SceneFields::check_dimensions(int dimensions) const {
  const std::string& complaint = dimensions == 2 ? deep_vector_ : flat_vector_;
  if (!complaint.empty()) throw Refused(complaint);
}

Color SceneFields::color(const JsonField& field) const {
  const std::string_view text = field.text();
  int digits[6] = {};
  bool sound = text.size() == 7 && text[0] == '#';
  for (std::size_t i = 0; sound && i < 6; ++i) {
    digits[i] = hexadecimal_digit(text[i + 1]);
    sound = digits[i] >= 0;
  }
  if (!sound) field.refuse("must be a colour \"#rrggbb\"");
  const auto channel = [&](int i) { return static_cast<std::uint8_t>(16 * digits[i] + digits[i + 1]); };
  return {channel(0), channel(2), channel(4)};
}

void SceneFields::keep_unknown(const JsonField& field, std::string& members, std::string_view text) {
  Unknown& unknown = unknown_keys_[std::string(field.key())];
  if (unknown.count++ == 0) unknown.first = field.path();
  if (!members.empty()) members += ", ";
  members += to_json(field.key()) + ": " + (text.empty() ? to_json(field.value()) : std::string(text));
}

std::vector<std::string> SceneFields::warnings(const std::string& file) const {
  std::vector<std::string> lines;
  for (const auto& [key, unknown] : unknown_keys_) {
    if (lines.size() == most_unknown_names) {
      lines.push_back(file + ": and " + std::to_string(unknown_keys_.size() - most_unknown_names) + " more unknown keys, kept");
      break;
    }
    lines.push_back(file + ": " + unknown.first + ": unknown key, kept" +
                    (unknown.count > 1 ? " (" + std::to_string(unknown.count) + " times)" : ""));
  }
  for (const std::string& warning : warnings_) lines.push_back(file + ": " + warning);
  return lines;
}

}  // namespace hooke
