// The table of file formats.
#include "formats/file_kinds.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

TEST(FileKinds, AreTheConstantsOfTheirFiles) {
  EXPECT_EQ(&json_file, find_file_kind("scene.json"));
  EXPECT_EQ(&obj_file, find_file_kind("mesh.OBJ"));
  EXPECT_EQ(&json_file, &file_kinds()[0]);
}

}  // namespace
}  // namespace hooke
