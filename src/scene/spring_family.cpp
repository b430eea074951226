#include "scene/spring_family.h"

#include <array>

namespace hooke {
namespace {

constexpr std::array<std::string_view, spring_families> names{"", "structural", "shear", "bend"};

}  // namespace

std::string_view name_of(SpringFamily family) { return names[static_cast<std::size_t>(family)]; }

SpringFamily read_family(const JsonField& field) {
  const std::string_view text = field.text();
  for (std::size_t i = 1; i < names.size(); ++i)
    if (text == names[i]) return static_cast<SpringFamily>(i);
  field.refuse("must be \"structural\", \"shear\" or \"bend\"");
}

}  // namespace hooke
