// Icons of buttons, drawn as strokes so that they are crisp at any scale.
#pragma once

#include <imgui.h>

namespace hooke {

enum class Icon { Select, Add, Attach, Nail, Drag, Delete, Release, Run, Pause, Step, Start, Undo, Redo, StepBack, Folder, Scene, Cut };

// Within a square of `size` around `center`.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 center, float size, ImU32 color);

}  // namespace hooke
