#include "cli/commands/commands.h"

#include <algorithm>
#include <iostream>

#include "base/build_info.h"
#include "base/json_writer.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "batch/check.h"
#include "batch/junit.h"
#include "batch/machine.h"
#include "batch/output_file.h"
#include "batch/run_frames.h"
#include "cli/interrupt.h"
#include "cli/progress_bar.h"
#include "formats/open_file.h"
#include "formats/scene_file.h"
#include "study/check/result_check.h"
#include "study/check_scene.h"
#include "study/hard_cases/case_report.h"

namespace hooke {
namespace {

struct CheckOptions {
  std::vector<std::string> scenes;   // none: all shipped scenes
  std::vector<std::string> methods;  // ids; none: all
  std::vector<int> cases;            // numbers; none: all
  std::optional<std::string> json, junit, markdown;
  int threads = 0;  // 0: one per core
  bool hard = false, quick = false, strict = false, quiet = false, result = false;
  std::optional<double> seconds;  // of --result
  bool writes_summary() const { return !json && !junit && !markdown && !quiet; }
};

void write(const std::optional<std::string>& file, const std::string& text) {
  if (!file) return;
  OutputFile output(*file);
  output.write(text);
  output.close();
}

// The command line that produces the same document.
std::string command_of(const CheckOptions& options) {
  const auto list = [](const char* option, const auto& items, const auto& word) {
    std::string words;
    for (const auto& item : items) words += (words.empty() ? option : ",") + word(item);
    return words;
  };
  std::string command = "hooke check --hard";
  if (options.quick) command += " --quick";
  if (options.strict) command += " --strict";
  command += list(" --cases ", options.cases, [](int number) { return std::to_string(number); });
  command += list(" --methods ", options.methods, [](const std::string& id) { return id; });
  return command + " --markdown " + printable(options.markdown.value_or("-"), 200);
}

int check_hard_cases(const CheckOptions& options) {
  const auto cases = chosen_cases(options.cases);
  std::vector<CaseResult> results = list_cases(cases, methods_for_cases(options.methods, options.quick), options.quick);
  if (results.empty()) throw UsageError("--quick excludes all of these cases");

  catch_interrupts();
  {
    ProgressBar progress(static_cast<long>(results.size()), !options.quiet);
    run_cases(results, options.threads > 0 ? options.threads : default_threads(), [&](long done, long) {
      if (done > 0) progress.show(done);
      return !was_interrupted();
    });
  }
  if (options.strict)
    for (CaseResult& result : results) result.verdict.expected = Expectation::Hold;

  if (was_interrupted()) std::cerr << "Interrupted. Results so far:\n";
  write(options.json, format_json(results));
  std::vector<JunitCase> reported;
  for (const CaseResult& each : results)
    if (each.finished)
      reported.push_back({.group = std::string(each.hard_case->name),
                          .name = std::string(each.method->id),
                          .failure = is_broken(each.verdict) ? "unexpected: " + each.verdict.measured : ""});
  write(options.junit, format_junit("hooke check --hard", reported, was_interrupted()));
  if (options.markdown && !was_interrupted())
    write(options.markdown,
          format_markdown(results, {.command = command_of(options), .date = time_text("%Y-%m-%d"), .machine = machine()}));
  if (options.writes_summary()) std::cout << format_table(results);
  if (was_interrupted()) return exit_interrupted();
  return count_broken(results) == 0 ? exit_code::success : exit_code::check_failed;
}

// {"version", "checks": [{"scene", "method", "passed", "measured"}], "failed", "interrupted"}
std::string format_checks(const std::vector<std::pair<std::string, CheckResult>>& results, long failed) {
  JsonWriter json;
  json.begin_object(JsonWriter::Layout::Lines);
  json.text("version", program_version);
  json.objects("checks", results, [&](const auto& named) {
    const auto& [name, result] = named;
    json.text("scene", name);
    json.text("method", result.method->id);
    json.boolean("passed", result.passed);
    json.text("measured", result.measured);
  });
  json.integer("failed", failed);
  json.boolean("interrupted", was_interrupted());
  json.end();
  return json.take() + "\n";
}

int check_scenes(const CheckOptions& options) {
  catch_interrupts();
  std::vector<std::pair<std::string, CheckResult>> results;
  const auto check_one = [&](const std::string& name) {
    const Scene scene = load_file(find_scene(name)).scene;
    for (CheckResult& result : check_scene(scene, &throw_if_interrupted)) {
      if (options.writes_summary())
        std::cout << (result.passed ? "passed  " : "FAILED  ") << printable(name, 80) << ", " << result.method->id << ": "
                  << result.measured << std::endl;
      results.emplace_back(name, std::move(result));
    }
  };
  try {
    for (const std::string& name : options.scenes.empty() ? shipped_scene_ids() : options.scenes) check_one(name);
  } catch (const Interrupted&) {
    std::cerr << "Interrupted. The results so far are complete.\n";
  }
  std::vector<JunitCase> cases;
  for (const auto& [name, result] : results)
    cases.push_back({.group = name, .name = std::string(result.method->id), .failure = result.passed ? "" : result.measured});
  const long failed = std::ranges::count_if(results, [](const auto& each) { return !each.second.passed; });
  write(options.json, format_checks(results, failed));
  write(options.junit, format_junit("hooke check", cases, was_interrupted()));
  if (was_interrupted()) return exit_interrupted();
  return failed == 0 ? exit_code::success : exit_code::check_failed;
}

int check_results(const CheckOptions& options) {
  if (options.scenes.size() != 1) throw UsageError("--result checks one SCENE");
  const Scene scene = load_file(find_scene(options.scenes.front())).scene;
  catch_interrupts();
  ResultCheck result;
  {
    constexpr double steps = 1000.0;
    ProgressBar progress(static_cast<long>(steps), !options.quiet);
    result = check_result(scene.system, scene.state, scene.settings, options.seconds.value_or(default_check_seconds), [&](double fraction) {
      progress.show(static_cast<long>(steps * fraction));
      return !was_interrupted();
    });
  }
  if (was_interrupted()) return std::cerr << "Interrupted: nothing was written.\n", exit_interrupted();
  write(options.json, format_json(result));
  if (!options.json && !options.quiet) std::cout << format_table(result);
  return result.note.empty() ? exit_code::success : exit_code::diverged;
}

int check(const CheckOptions& options) {
  const bool of_one_result = options.result || options.seconds;
  if (options.seconds && !options.result) throw UsageError("--seconds requires --result");
  if (of_one_result && (options.hard || options.quick || options.strict || options.junit || options.markdown || !options.methods.empty() ||
                        !options.cases.empty() || options.threads > 0))
    throw UsageError("--result accepts only SCENE, --seconds, --json and --quiet");
  if (options.result) return check_results(options);
  const bool of_hard_cases =
      options.quick || options.strict || options.markdown || !options.methods.empty() || !options.cases.empty() || options.threads > 0;
  if (of_hard_cases && !options.hard) throw UsageError("--quick, --strict, --cases, --methods, --threads and --markdown require --hard");
  require_separate_files({}, {{"--json", options.json}, {"--junit", options.junit}, {"--markdown", options.markdown}});
  if (options.hard && !options.scenes.empty()) throw UsageError("--hard has its own scenes and accepts no SCENE");
  return options.hard ? check_hard_cases(options) : check_scenes(options);
}

}  // namespace

std::function<int()> declare_check(CLI::App& app) {
  auto options = std::make_shared<CheckOptions>();
  app.add_option("SCENE", options->scenes, "Files or names of shipped scenes; default: all shipped scenes")->type_name("");
  app.add_flag("--hard", options->hard, "Run the hard cases with every method instead");
  app.add_flag(
      "--result", options->result,
      "Run the scene with half the step, and with twice the resolution of its sheets and ropes: how far its sag, period, maximum strain "
      "and energy depend on them");
  app.add_option("--seconds", options->seconds, "Simulated time of --result; default: 2")
      ->type_name("S")
      ->transform(within({.min = 1e-6, .max = 1e4}));
  app.add_flag("--quick", options->quick, "With --hard: only the fast cases, without auto: about a minute of CPU time in total");
  app.add_flag("--strict", options->strict, "With --hard: count every failure, even a reported one that is allowed");
  app.add_option("--cases", options->cases, "With --hard: only these cases, by number")
      ->type_name("1,20")
      ->delimiter(',')
      ->transform(within({.min = 1, .max = 1e6}));
  app.add_option("--methods", options->methods, "With --hard: only these methods, by id")->type_name("a,b")->delimiter(',');
  app.add_option("--threads", options->threads, "With --hard: number of cases to run in parallel; default: one per core")
      ->type_name("N")
      ->transform(within({.min = 1, .max = 256}));
  app.add_option("--json", options->json, "Write the results as JSON; - for stdout")->type_name("FILE");
  app.add_option("--junit", options->junit, "Write the results as JUnit XML; - for stdout")->type_name("FILE");
  app.add_option("--markdown", options->markdown, "Write the tables of docs/evidence/stability.md; - for stdout")->type_name("FILE");
  app.add_flag("-q,--quiet", options->quiet, "Print only errors");
  return [options] { return check(*options); };
}

}  // namespace hooke
