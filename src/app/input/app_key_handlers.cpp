// The key handlers of the window, from the topmost panel down.
#include "app/app.h"
#include "formats/gallery.h"
#include "formats/scene_file.h"

namespace hooke {

KeyHandlers App::make_key_handlers() {
  using Target = PanelKey::Target;
  const auto pass_on = [this](Target target, const KeyPress& press) { keyboard_.for_panels.push_back({target, press.key}); };
  // Esc closes an overlay
  const auto close = [this](bool& shown, const KeyPress& press) {
    if (!shown || press.key != Key::Escape) return false;
    shown = false;
    panels_.messages.toast.clear();
    return true;
  };

  return {
      // a modal dialog takes all keys
      {"dialog",
       [this, pass_on](const KeyPress& press) {
         if (panels_.dialog.kind == Dialog::Kind::None) return false;
         pass_on(Target::Dialog, press);
         return true;
       }},
      // so does the command palette, where letters are typed
      {"search",
       [this, pass_on, close](const KeyPress& press) {
         if (!panels_.search.shown) return false;
         if (!close(panels_.search.shown, press)) pass_on(Target::Search, press);
         return true;
       }},
      {"menu",
       [this, pass_on](const KeyPress& press) {
         if (!panels_.menus.is_open) return false;
         if (press.key == Key::Escape) panels_.messages.toast.clear();
         pass_on(Target::Menu, press.key == Key::F10 || press.key == Key::Alt ? KeyPress{Key::Escape, {}} : press);
         return true;
       }},
      // all keys, unless a number is being typed
      {"export",
       [this, pass_on, close](const KeyPress& press) {
         if (!panels_.export_state.is_shown || panels_.field.typing != 0) return false;
         if (press.key == Key::Escape && exporter_.is_running())
           exporter_.stop();
         else if (!close(panels_.export_state.is_shown, press) && press.key == Key::Enter)
           pass_on(Target::Export, press);
         return true;
       }},
      // a text field passes on only F1 and combinations with Ctrl
      {"text field",
       [this](const KeyPress& press) { return panels_.field.text_in_progress && press.key != Key::F1 && !press.modifiers.control; }},
      {"placement",
       [this](const KeyPress& press) {
         if (!placer_.is_on() || (press.key != Key::Enter && press.key != Key::Escape)) return false;
         if (press.key == Key::Enter)
           placer_.place();
         else
           placer_.stop();
         return true;
       }},
      {"shortcut overlay", [this, close](const KeyPress& press) { return close(panels_.shown.keys, press); }},
      {"gallery", [this, close](const KeyPress& press) { return close(panels_.gallery.is_shown, press) || press_in_gallery(press); }},
      {"shortcuts", [this](const KeyPress& press) { return perform_shortcut(press); }},
  };
}

bool App::press_in_gallery(const KeyPress& press) {
  if (!panels_.gallery.is_shown || press.modifiers != Modifiers{}) return false;
  if (move_in_gallery(panels_, tool_context_.layout, press.key)) return true;
  if (press.key == Key::Enter) document_.open(shipped_scenes()[panels_.gallery.chosen].file);
  return press.key == Key::Enter;
}

bool App::perform_shortcut(const KeyPress& press) {
  const Shortcut* shortcut = find_shortcut(press.key, press.modifiers);
  if (shortcut == nullptr || (press.repeated && !shortcut->repeats)) return false;
  // the gallery hides the scene: keys must not affect it
  const Needs needs = row_of(shortcut->action).needs;
  if (panels_.gallery.is_shown && needs != Needs::Nothing) return false;
  settle();
  if (needs == Needs::Selection && tool_context_.selection.empty())
    panels_.show_toast("Nothing is selected");
  else if (needs == Needs::UndoStep && status().history.undo_name.empty())
    panels_.show_toast("There is nothing to undo");
  else if (needs == Needs::RedoStep && status().history.redo_name.empty())
    panels_.show_toast("There is nothing to redo");
  else
    perform(shortcut->action, press.repeated);
  return true;
}

}  // namespace hooke
