// The rows of a sweep on disk, one line each, from which an interrupted sweep resumes and the parts of a distributed one are merged.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "batch/sweep/sweep.h"

namespace hooke {

inline constexpr const char* sweep_journal_name = "sweep.jsonl";

// The finished rows, by number.
using SweepRows = std::map<std::size_t, SweepRow>;

// The first line of a journal. Equal lines mean the same sweep by the same version of the program, whose rows can be put into one table.
std::string format_definition(const Sweep& sweep);

struct JournalContents {
  Sweep sweep;
  std::string definition;
  SweepRows rows;
  std::size_t complete_bytes = 0;  // up to the end of the last complete line: a process that is killed may leave part of a line
};
// Throws InputError ("FILE: line N: ...") unless the text is a journal; `name` is the file in messages.
JournalContents parse_journal(const std::string& text, const std::string& name);

// The same line by line, for a journal that is written at once.
std::string format_journal(const Sweep& sweep, const SweepRows& rows);

// A journal open for appending, which no other process may have open. Everything throws FileError; opening also InputError, if the file
// belongs to another sweep.
class SweepJournal {
 public:
  SweepJournal(const std::filesystem::path& file, const Sweep& sweep);
  ~SweepJournal();
  SweepJournal(const SweepJournal&) = delete;
  SweepJournal& operator=(const SweepJournal&) = delete;

  const SweepRows& rows() const { return rows_; }
  // When it returns, the row survives the end of this process.
  void add(const SweepRow& row);

 private:
  void write(const std::string& text);
  std::filesystem::path file_;
  int descriptor_ = -1;
  SweepRows rows_;
};

// The rows of all journals together; of a row that several of them have, the first counts. Throws InputError if they belong to different
// sweeps.
JournalContents merge_journals(const std::vector<std::filesystem::path>& files);

}  // namespace hooke
