// The table of a sweep as CSV and JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "batch/sweep/sweep_journal.h"

namespace hooke {

// "ok", "warning", "diverged".
std::string_view sweep_status_name(SweepRow::Status status);
std::optional<SweepRow::Status> find_sweep_status(std::string_view name);

// A heading with units, and one line per finished row: the parameters, the measures, status and note. Empty: not known.
std::string format_sweep_csv(const Sweep& sweep, const SweepRows& rows);

// The same with the definition of the sweep; null: not known.
std::string format_sweep_json(const Sweep& sweep, const SweepRows& rows);

}  // namespace hooke
