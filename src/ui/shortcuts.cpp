#include "ui/shortcuts.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace hooke {
namespace {

constexpr Modifiers plain{}, control{.control = true}, control_shift{.control = true, .shift = true};

constexpr std::string_view tools = "Tools", run = "Run", tune = "Tune", edit = "Edit", look = "Look", file = "File";

// clang-format off
constexpr std::array rows{
    Shortcut{letter('V'), plain, Action::SelectTool, tools, "Select and move"},
    Shortcut{letter('A'), plain, Action::AddTool, tools, "Add a point"},
    Shortcut{letter('T'), plain, Action::AttachTool, tools, "Attach two points"},
    Shortcut{letter('N'), plain, Action::NailTool, tools, "Nail or free a point"},
    Shortcut{letter('D'), plain, Action::DragTool, tools, "Drag a point"},
    Shortcut{letter('X'), plain, Action::CutTool, tools, "Cut springs and cloth"},
    Shortcut{letter('E'), plain, Action::DeleteTool, tools, "Delete a point or spring"},

    Shortcut{Key::Space, plain, Action::RunOrPause, run, "Run or pause"},
    Shortcut{Key::Period, plain, Action::StepOnce, run, "One frame further", true},
    Shortcut{letter(','), plain, Action::StepBack, run, "One frame back", true},
    Shortcut{letter('['), plain, Action::Slower, run, "Half as fast", true},
    Shortcut{letter(']'), plain, Action::Faster, run, "Twice as fast", true},
    Shortcut{letter('R'), control, Action::GoToStart, run, "Back to the start"},
    Shortcut{letter('R'), plain, Action::ReleaseNails, run, "Release every nail"},

    Shortcut{Key::Up, plain, Action::StiffnessUp, tune, "Stiffer springs", true},
    Shortcut{Key::Down, plain, Action::StiffnessDown, tune, "Softer springs", true},
    Shortcut{Key::Right, plain, Action::SubstepsUp, tune, "5 substeps more", true},
    Shortcut{Key::Left, plain, Action::SubstepsDown, tune, "5 substeps fewer", true},

    Shortcut{letter('Z'), control, Action::Undo, edit, "Undo", true},
    Shortcut{letter('Z'), control_shift, Action::Redo, edit, "Redo", true},
    Shortcut{letter('Y'), control, Action::Redo, edit, "Redo", true},
    Shortcut{letter('A'), control, Action::SelectAll, edit, "Select everything"},
    Shortcut{letter('I'), control, Action::SelectInverted, edit, "Select what is not selected"},
    Shortcut{letter('L'), control, Action::SelectConnected, edit, "Select what is connected"},
    Shortcut{letter('D'), control, Action::Duplicate, edit, "Duplicate the selection"},
    Shortcut{letter('X'), control, Action::Cut, edit, "Cut the selection"},
    Shortcut{letter('C'), control, Action::Copy, edit, "Copy the selection"},
    Shortcut{letter('V'), control, Action::Paste, edit, "Paste under the cursor"},
    Shortcut{Key::Delete, plain, Action::DeleteSelection, edit, "Delete the selection"},
    Shortcut{Key::Backspace, plain, Action::DeleteSelection, edit, "Delete the selection"},
    Shortcut{Key::Escape, plain, Action::Cancel, edit, "Cancel; select nothing"},

    Shortcut{Key::Home, plain, Action::FrameAll, look, "See the whole scene"},
    Shortcut{letter('G'), plain, Action::ShowGallery, look, "Gallery of scenes"},
    Shortcut{letter('P'), plain, Action::ShowPlots, look, "Plots"},
    Shortcut{Key::Tab, plain, Action::HidePanels, look, "Hide the panels, or show them"},
    Shortcut{letter('L'), control_shift, Action::LightOrDark, look, "Light or dark"},
    Shortcut{letter('F'), plain, Action::FrameSelection, look, "See the selection"},
    Shortcut{letter('1'), plain, Action::ViewFront, look, "From the front, or from behind"},
    Shortcut{letter('3'), plain, Action::ViewSide, look, "From the right, or from the left"},
    Shortcut{letter('7'), plain, Action::ViewTop, look, "From above, or from below"},
    Shortcut{letter('5'), plain, Action::Orthographic, look, "Orthographic or perspective"},
    Shortcut{letter('9'), plain, Action::FollowScene, look, "Follow what moves, or stay"},
    Shortcut{letter('C'), control_shift, Action::CopyCamera, look, "Copy the camera as text"},
    Shortcut{letter('V'), control_shift, Action::PasteCamera, look, "Paste a camera"},
    Shortcut{letter('='), control, Action::LargerPanels, look, "Larger panels"},
    Shortcut{letter('-'), control, Action::SmallerPanels, look, "Smaller panels"},
    Shortcut{letter('P'), control_shift, Action::SearchCommands, look, "Search all commands"},
    Shortcut{Key::F1, plain, Action::ShowKeys, look, "Show these keys"},

    Shortcut{letter('N'), control, Action::NewScene, file, "New scene"},
    Shortcut{letter('O'), control, Action::OpenScene, file, "Open..."},
    Shortcut{letter('S'), control, Action::Save, file, "Save"},
    Shortcut{letter('S'), control_shift, Action::SaveAs, file, "Save as..."},
    Shortcut{letter('E'), control, Action::Export, file, "Export..."},
    Shortcut{letter('P'), control, Action::TakePicture, file, "Take a picture"},
    Shortcut{Key::F12, plain, Action::FilmOnOff, file, "Start or end a film"},
    Shortcut{letter('R'), control_shift, Action::RecordOnOff, file, "Start or end a recording"},
    Shortcut{letter('Q'), control, Action::Quit, file, "Quit"},
};

constexpr std::array hints{
    MouseHint{"Right or middle drag", "Orbit; pan in a flat scene"},
    MouseHint{"Shift + middle drag", "Pan"},
    MouseHint{"Wheel", "Zoom to the cursor"},
    MouseHint{"Double click on a point", "Select what is connected"},
    MouseHint{"Ctrl + click on a slider", "Type a value"},
    MouseHint{"Right click on a slider", "Its usual value"},
};

constexpr std::array named_keys{
    std::pair{Key::Space, "Space"}, std::pair{Key::Escape, "Esc"}, std::pair{Key::Enter, "Enter"}, std::pair{Key::Tab, "Tab"}, std::pair{Key::Delete, "Del"}, std::pair{Key::Backspace, "Backspace"},
    std::pair{Key::Right, "Right"}, std::pair{Key::Left, "Left"}, std::pair{Key::Down, "Down"}, std::pair{Key::Up, "Up"},
    std::pair{Key::Home, "Home"}, std::pair{Key::F1, "F1"}, std::pair{Key::F12, "F12"},
};
// clang-format on

}  // namespace

std::span<const Shortcut> shortcuts() { return rows; }
std::span<const MouseHint> mouse_hints() { return hints; }

const Shortcut* find_shortcut(Key key, Modifiers modifiers) {
  for (const Shortcut& row : rows)
    if (row.key == key && row.modifiers == modifiers) return &row;
  return nullptr;
}

const Shortcut& shortcut_of(Action action) {
  const auto row = std::ranges::find(rows, action, &Shortcut::action);
  assert(row != rows.end());
  return *row;
}

std::string key_text(const Shortcut& shortcut) {
  std::string text;
  if (shortcut.modifiers.control) text += "Ctrl+";
  if (shortcut.modifiers.shift) text += "Shift+";
  for (const auto& [key, name] : named_keys)
    if (key == shortcut.key) return text + name;
  return text + static_cast<char>(shortcut.key);
}

}  // namespace hooke
