#include "lab/sheet_shares.h"

#include <utility>

namespace hooke {

SheetEdit::~SheetEdit() {
  if (!changed_) return;
  for (std::vector<double>* list : {&changed_->area, &changed_->share})
    while (!list->empty() && !(list->back() > 0.0)) list->pop_back();
  const bool is_any = !changed_->area.empty() || !changed_->share.empty();
  sheet_ = is_any ? std::make_shared<const SheetShares>(std::move(*changed_)) : nullptr;
}

// Each id is set once, so that what was before is still in the sheet.
void SheetEdit::set(std::vector<double> SheetShares::*list, std::size_t id, double value, double before) {
  if (value == before) return;
  if (!changed_) changed_ = sheet_ ? *sheet_ : SheetShares{};
  std::vector<double>& values = (*changed_).*list;
  if (id >= values.size()) values.resize(id + 1, 0.0);
  values[id] = value;
}

}  // namespace hooke
