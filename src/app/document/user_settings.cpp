#include "app/document/user_settings.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"

namespace hooke {

UserSettings::UserSettings(const Home& home, Panels& panels) : folder_(home.config), panels_(panels) {
  LoadedPreferences loaded = load_preferences(folder_);
  values_ = loaded.preferences;
  panels_.look = values_.light ? Look::Light : Look::Dark;
  if (!loaded.message.empty()) panels_.queue_message("Settings ignored; using defaults", std::move(loaded.message));
}

void UserSettings::scale_interface(double factor) {
  const PreferenceRow& row = preference_rows()[0];
  values_.interface_scale = std::clamp(std::round(20.0 * factor * values_.interface_scale) / 20.0, row.min, row.max);
  panels_.show_toast("Interface scale " + std::to_string(std::lround(100.0 * values_.interface_scale)) + " %");
  save();
}

void UserSettings::switch_look() {
  values_.light = panels_.look == Look::Dark;
  panels_.look = values_.light ? Look::Light : Look::Dark;
  save();
}

void UserSettings::set_measure_accuracy(bool on) {
  values_.measure_accuracy = on;
  save();
}

void UserSettings::save() {
  try {
    save_preferences(values_, folder_);
  } catch (const FileError& error) {
    panels_.show_toast(error.what());
  }
}

}  // namespace hooke
