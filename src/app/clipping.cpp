// Parts of the scene as text on the clipboard, so that they go from one Hooke to another; and duplicates.
#include "app/app.h"
#include "lab/excerpt.h"
#include "lab/scene_file.h"
#include "ui/text.h"

namespace hooke {
namespace {

// A text of more points than this would take longer than a person waits.
constexpr Index most_points = 50000;
// How far beside what it was made from a duplicate lies [units of design].
constexpr double beside = 28.0;

std::string count_of(const Scene& part) {
  return count(part.system.point_count(), "point") + " and " + count(part.system.spring_count(), "spring");
}

}  // namespace

void App::copy(Afterwards afterwards) {
  auto part = std::make_shared<const Scene>(excerpt(bench_.snapshot(), bench_.status->sheet, selection_));
  if (part->system.points().empty()) return panels_.say("Nothing is selected");
  if (part->system.point_count() > most_points)
    return panels_.say("Too much for the clipboard: " + count(part->system.point_count(), "point") + ", it takes " +
                       std::to_string(most_points));
  begin_work("Copying " + count_of(*part), [this, part, afterwards](const GoesOn& goes_on) -> LongWork::Finish {
    try {
      return [this, part, afterwards, text = format_scene(*part, goes_on)] {
        clipboard_.put(text);
        panels_.say("Copied " + count_of(*part));
        if (afterwards == Afterwards::Delete) delete_selection();
      };
    } catch (const FileError&) {
      return [this] { panels_.say("Stopped: nothing was copied"); };
    }
  });
}

// Under the cursor, or beside the middle of the scene's picture when it is elsewhere.
void App::paste() {
  std::string text = clipboard_.take();
  if (text.empty()) return panels_.say("The clipboard is empty");
  begin_work("Pasting", [this, text = std::move(text)](const GoesOn& goes_on) -> LongWork::Finish {
    try {
      auto part = std::make_shared<const Scene>(parse_scene(text, "clipboard", goes_on).scene);
      return [this, part] { paste(*part); };
    } catch (const Refused&) {
      return [this] { panels_.say(work_.was_stopped() ? "Stopped: nothing was pasted" : "The clipboard holds no part of a scene"); };
    }
  });
}

void App::paste(const Scene& part) {
  if (part.system.points().empty()) return panels_.say("The clipboard holds no points");
  const bool over_scene = !panels_cover(panels_, layout_, cursor_.x, cursor_.y);
  const Vec3 middle = middle_of(part);
  put_in(part, bench_.place_beside(over_scene ? pointer().at : 0.5 * bench_.size, middle) - middle);
  panels_.say("Pasted " + count_of(part));
}

void App::duplicate() {
  const Scene part = excerpt(bench_.snapshot(), bench_.status->sheet, selection_);
  if (part.system.points().empty()) return panels_.say("Nothing is selected");
  const Vec3 middle = middle_of(part);
  const auto seen = seen_at(bench_.lens(), middle);
  put_in(part, seen ? bench_.place_beside(*seen + glm::dvec2(beside * bench_.scale), middle) - middle : Vec3(0.0));
}

void App::put_in(const Scene& part, const Vec3& way) {
  Insert insert = insertion_of(part, way, {[this] { return lab_.new_point_id(); }, [this] { return lab_.new_spring_id(); }});
  Selection coming;
  for (const PlacedPoint& placed : insert.points) coming.points.push_back(placed.point.id);
  for (const PlacedSpring& placed : insert.springs) coming.springs.push_back(placed.spring.id);
  lab_.submit(std::move(insert));
  settle();
  selection_ = std::move(coming);
}

}  // namespace hooke
