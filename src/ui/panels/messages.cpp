// The log of what the program said: short messages over the scene, and the texts of banners.
#include <ctime>

#include "ui/docked_panel.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

constexpr std::size_t max_entries = 500;

std::string time_of_day() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  char text[16];
  std::strftime(text, sizeof text, "%H:%M:%S", &local);
  return text;
}

// The texts that banners show stay in the log when they are dismissed.
void log_banners(const PanelInput& input, Panels& panels) {
  std::string shown;
  const Panels& constant = panels;
  for (const std::string* text : {&input.status.diagnosis.message, &constant.banners.file_notice, &constant.banners.file_warnings}) {
    if (text->empty()) continue;
    if (panels.messages.banners.find(*text) == std::string::npos) panels.messages.log(*text);
    shown += *text + '\n';
  }
  panels.messages.banners = std::move(shown);
}

}  // namespace

void Messages::log(const std::string& text) {
  if (!entries.empty() && entries.back().text == text) entries.pop_back();
  entries.push_back({time_of_day(), text});
  if (entries.size() > max_entries) entries.pop_front();
}

void build_messages(const PanelInput& input, Panels& panels) {
  log_banners(input, panels);
  Messages& messages = panels.messages;
  if (!messages.is_shown) return;
  DockedPanel panel("messages", dock_panel(input.layout, units(1.0), left_panel_width(input, panels, 420.0), 400.0), panels);
  strong_text("Messages");
  panel.begin_content();
  if (messages.entries.empty()) dim_text("None so far");
  // the newest first
  for (auto entry = messages.entries.rbegin(); entry != messages.entries.rend(); ++entry) {
    dim_text(entry->time);
    ImGui::SameLine(units(78.0));
    paragraph(entry->text);
  }
  panel.end_content();
  if (ImGui::Button("Close", {units(96.0), units(30.0)})) messages.is_shown = false;
}

}  // namespace hooke
