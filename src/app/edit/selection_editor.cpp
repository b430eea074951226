#include "app/edit/selection_editor.h"

#include "formats/scene_file.h"
#include "sim/model/bounding_box.h"
#include "ui/text.h"

namespace hooke {
namespace {

// The text of a larger part would take too long to write and parse.
constexpr Index max_copied_points = 50000;
// Offset of a duplicate from the original [design units].
constexpr double duplicate_offset = 28.0;

std::string count_of(const Scene& part) {
  return count(part.system.point_count(), "point") + " and " + count(part.system.spring_count(), "spring");
}

}  // namespace

Scene SelectionEditor::selected_part() const {
  return copy_selection(context_.snapshot(), context_.status->document->sheet, context_.selection);
}

void SelectionEditor::copy(AfterCopy after_copy) {
  auto part = std::make_shared<const Scene>(selected_part());
  if (part->system.points().empty()) return panels_.show_toast("No point or spring is selected");
  if (part->system.point_count() > max_copied_points)
    return panels_.show_toast("Too large for the clipboard: " + count(part->system.point_count(), "point") + ", the limit is " +
                              number_text(max_copied_points));
  task_.start("Copying " + count_of(*part), [this, part, after_copy](const Progress& progress) -> BackgroundTask::Completion {
    try {
      return [this, part, after_copy, text = format_scene(*part, progress)] {
        clipboard_.put(text);
        panels_.show_toast("Copied " + count_of(*part));
        if (after_copy == AfterCopy::Delete) delete_selection();
      };
    } catch (const FileError&) {
      return [this] { panels_.show_toast("Canceled: nothing was copied"); };
    }
  });
}

void SelectionEditor::paste(const std::optional<glm::dvec2>& place) {
  std::string text = clipboard_.take();
  if (text.empty()) return panels_.show_toast("The clipboard is empty");
  task_.start(
      "Pasting",
      [this, text = std::move(text), at = place.value_or(0.5 * context_.size)](const Progress& progress) -> BackgroundTask::Completion {
        try {
          auto part = std::make_shared<const Scene>(parse_scene(text, "clipboard", progress).scene);
          return [this, part, at] { paste(*part, at); };
        } catch (const InputError&) {
          return [this] {
            panels_.show_toast(task_.was_stopped() ? "Canceled: nothing was pasted"
                                                   : "The clipboard does not contain part of a scene: copy points first");
          };
        }
      });
}

void SelectionEditor::paste(const Scene& part, const glm::dvec2& place) {
  if (part.system.points().empty()) return panels_.show_toast("The clipboard contains no points");
  const Vec3 middle = bounding_box(part.state.position).center();
  insert(part, context_.point_in_view_plane(place, middle) - middle);
  panels_.show_toast("Pasted " + count_of(part));
}

void SelectionEditor::duplicate() {
  const Scene part = selected_part();
  if (part.system.points().empty()) return panels_.show_toast("No point or spring is selected");
  const Vec3 middle = bounding_box(part.state.position).center();
  const auto seen = project_to_screen(context_.view_transform(), middle);
  const glm::dvec2 offset(duplicate_offset * context_.scale);
  insert(part, seen ? context_.point_in_view_plane(*seen + offset, middle) - middle : Vec3(0.0));
}

// Selects what was inserted.
void SelectionEditor::insert(const Scene& part, const Vec3& displacement) {
  Insert insert = make_insert(part, displacement, context_.new_ids());
  Selection inserted;
  for (const PlacedPoint& placed : insert.points) inserted.points.push_back(placed.point.id);
  for (const PlacedSpring& placed : insert.springs) inserted.springs.push_back(placed.spring.id);
  context_.lab.submit(std::move(insert));
  context_.settle();
  context_.selection = std::move(inserted);
}

void SelectionEditor::weld() {
  const std::vector<PointId> points = context_.selection.points;
  if (points.size() < 2) return panels_.show_toast("Select the points to weld: two or more");
  const Gesture gesture = context_.begin_gesture();
  const std::string shown = count(std::ssize(points), "point");
  for (Command& command : hooke::weld(context_.snapshot(), context_.status->document->sheet.get(), points, context_.new_ids()))
    context_.lab.submit(std::move(command), gesture, "weld " + shown);
  panels_.show_toast("Welded " + shown);
  context_.selection = {{points.front()}, {}};
}

void SelectionEditor::split() {
  std::vector<Command> commands =
      hooke::split(context_.snapshot(), context_.status->document->sheet.get(), context_.selection.points, context_.new_ids());
  if (commands.empty()) return panels_.show_toast("Nothing to split: select points where springs meet, outside of surfaces");
  const Gesture gesture = context_.begin_gesture();
  const std::string name = "split " + count(std::ssize(context_.selection.points), "point");
  for (Command& command : commands) context_.lab.submit(std::move(command), gesture, name);
  panels_.show_toast("Split: each spring has an end of its own");
}

void SelectionEditor::delete_selection() {
  if (context_.selection.empty()) return;
  if (const auto collider = context_.selection.collider)
    context_.lab.submit(removal_of_collider(*collider, context_));
  else
    context_.lab.submit(Remove{context_.selection.points, context_.selection.springs});
  context_.selection = {};
}

}  // namespace hooke
