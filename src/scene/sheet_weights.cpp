#include "scene/sheet_weights.h"

#include <utility>

namespace hooke {

SheetEdit::~SheetEdit() {
  if (!changed_) return;
  for (NumberList* list : {&changed_->area, &changed_->spring_weight})
    while (!list->empty() && !(list->back() > 0.0)) list->pop_back();
  const bool is_any = !changed_->area.empty() || !changed_->spring_weight.empty();
  sheet_ = is_any ? std::make_shared<const SheetWeights>(std::move(*changed_)) : nullptr;
}

// Each id is set once, so that the previous value is still in the sheet.
void SheetEdit::set(NumberList SheetWeights::*list, std::size_t id, double value, double before) {
  if (value == before) return;
  if (!changed_) changed_ = sheet_ ? *sheet_ : SheetWeights{};
  NumberList& values = (*changed_).*list;
  if (id >= values.size()) values.resize(id + 1, 0.0);
  values.set(id, value);
}

}  // namespace hooke
