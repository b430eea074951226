// Parts of the scene as text on the clipboard, so that they go from one Hooke to another; and duplicates.
#include "app/app.h"
#include "edit/copy_selection.h"
#include "formats/scene_file.h"
#include "ui/text.h"

namespace hooke {
namespace {

// A text of more points than this would take longer than a person waits.
constexpr Index max_points = 50000;
// How far beside what it was made from a duplicate lies [units of design].
constexpr double beside = 28.0;

std::string count_of(const Scene& part) {
  return count(part.system.point_count(), "point") + " and " + count(part.system.spring_count(), "spring");
}

}  // namespace

void App::copy(AfterCopy after_copy) {
  auto part = std::make_shared<const Scene>(copy_selection(tool_context_.snapshot(), tool_context_.status->document->sheet, selection_));
  if (part->system.points().empty()) return panels_.show_toast("Nothing is selected");
  if (part->system.point_count() > max_points)
    return panels_.show_toast("Too much for the clipboard: " + count(part->system.point_count(), "point") + ", it takes " +
                              std::to_string(max_points));
  begin_work("Copying " + count_of(*part), [this, part, after_copy](const Progress& progress) -> BackgroundTask::Completion {
    try {
      return [this, part, after_copy, text = format_scene(*part, progress)] {
        clipboard_.put(text);
        panels_.show_toast("Copied " + count_of(*part));
        if (after_copy == AfterCopy::Delete) delete_selection();
      };
    } catch (const FileError&) {
      return [this] { panels_.show_toast("Stopped: nothing was copied"); };
    }
  });
}

// Under the cursor, or beside the middle of the scene's picture when it is elsewhere.
void App::paste() {
  std::string text = clipboard_.take();
  if (text.empty()) return panels_.show_toast("The clipboard is empty");
  begin_work("Pasting", [this, text = std::move(text)](const Progress& progress) -> BackgroundTask::Completion {
    try {
      auto part = std::make_shared<const Scene>(parse_scene(text, "clipboard", progress).scene);
      return [this, part] { paste(*part); };
    } catch (const InputError&) {
      return [this] { panels_.show_toast(work_.was_stopped() ? "Stopped: nothing was pasted" : "The clipboard holds no part of a scene"); };
    }
  });
}

void App::paste(const Scene& part) {
  if (part.system.points().empty()) return panels_.show_toast("The clipboard holds no points");
  const bool over_scene = !panels_cover(panels_, layout_, cursor_.x, cursor_.y);
  const Vec3 middle = bounding_box_center(part);
  insert_part(part, tool_context_.point_in_view_plane(over_scene ? pointer().at : 0.5 * tool_context_.size, middle) - middle);
  panels_.show_toast("Pasted " + count_of(part));
}

void App::duplicate() {
  const Scene part = copy_selection(tool_context_.snapshot(), tool_context_.status->document->sheet, selection_);
  if (part.system.points().empty()) return panels_.show_toast("Nothing is selected");
  const Vec3 middle = bounding_box_center(part);
  const auto seen = project_to_screen(tool_context_.view_transform(), middle);
  insert_part(part,
              seen ? tool_context_.point_in_view_plane(*seen + glm::dvec2(beside * tool_context_.scale), middle) - middle : Vec3(0.0));
}

void App::insert_part(const Scene& part, const Vec3& displacement) {
  Insert insert = make_insert(part, displacement, {[this] { return lab_.new_point_id(); }, [this] { return lab_.new_spring_id(); }});
  Selection coming;
  for (const PlacedPoint& placed : insert.points) coming.points.push_back(placed.point.id);
  for (const PlacedSpring& placed : insert.springs) coming.springs.push_back(placed.spring.id);
  lab_.submit(std::move(insert));
  settle();
  selection_ = std::move(coming);
}

}  // namespace hooke
