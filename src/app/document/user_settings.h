// The current preferences of the user, saved to a file when they change.
#pragma once

#include "app/document/home.h"
#include "app/document/preferences.h"
#include "ui/panels.h"

namespace hooke {

class UserSettings {
 public:
  // Loads them and applies the theme to the panels. An invalid file is reported there.
  UserSettings(const Home& home, Panels& panels);

  const Preferences& values() const { return values_; }
  // Multiplies the interface scale, in steps of 5 %.
  void scale_interface(double factor);
  // Switches between the dark and light themes.
  void switch_look();
  void set_measure_accuracy(bool on);

 private:
  void save();

  std::filesystem::path folder_;
  Panels& panels_;
  Preferences values_;
};

}  // namespace hooke
