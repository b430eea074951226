#include "batch/junit.h"

#include <algorithm>

namespace hooke {
namespace {

// In an attribute. XML allows no control characters.
std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + "\"";
}

}  // namespace

std::string format_junit(const std::string& name, std::vector<JunitCase> cases, bool is_interrupted) {
  if (is_interrupted) cases.push_back({name, "interrupted", "the run was interrupted before its end"});
  const auto failures = std::ranges::count_if(cases, [](const JunitCase& each) { return !each.failure.empty(); });
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=" + in_quotes(name) + " tests=\"" +
                     std::to_string(cases.size()) + "\" failures=\"" + std::to_string(failures) + "\">\n";
  for (const JunitCase& each : cases) {
    text += "  <testcase classname=" + in_quotes(each.group) + " name=" + in_quotes(each.name);
    text += each.failure.empty() ? "/>\n" : "><failure message=" + in_quotes(each.failure) + "/></testcase>\n";
  }
  return text + "</testsuite>\n";
}

}  // namespace hooke
