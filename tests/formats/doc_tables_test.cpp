// Documentation pages with tables that are generated from those of the program.
#include "formats/doc_tables.h"

#include <gtest/gtest.h>

#include "support/contents.h"

namespace hooke {
namespace {

TEST(DocTables, AreUpToDate) {
  for (const char* name : {"reference/scene-format.md", "reference/file-formats.md", "reference/command-line.md"}) {
    const std::string text = contents(DOCS_FOLDER "/" + std::string(name));
    EXPECT_NE(text.find("<!-- table "), std::string::npos) << name;
    EXPECT_EQ(with_doc_tables(text), text) << "run: build/release/bin/make_manual docs docs/reference/*.md";
  }
}

TEST(DocTables, ReplaceTheTextBetweenTheirMarks) {
  const std::string text = with_doc_tables("before\n<!-- table shapes -->\nstale text\n<!-- end -->\nafter\n");
  EXPECT_EQ(text.find("stale text"), std::string::npos);
  EXPECT_NE(text.find("| `jelly` |"), std::string::npos);
  EXPECT_TRUE(text.starts_with("before\n") && text.ends_with("<!-- end -->\nafter\n"));
}

}  // namespace
}  // namespace hooke
