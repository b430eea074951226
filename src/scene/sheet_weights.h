// The weights of points and springs in their sheets, with which the material sliders set each point and spring from the properties of the
// sheet.
#pragma once

#include <memory>
#include <optional>

#include "base/lists/number_list.h"
#include "sim/model/system.h"

namespace hooke {

// By id. 0, also beyond the end: not part of a sheet.
struct SheetWeights {
  NumberList area;           // [m^2], of each point
  NumberList spring_weight;  // [1], of each spring

  double area_of(PointId id) const { return at(area, static_cast<std::size_t>(id)); }
  double sheet_weight_of(SpringId id) const { return at(spring_weight, static_cast<std::size_t>(id)); }
  bool operator==(const SheetWeights&) const = default;

 private:
  static double at(const NumberList& list, std::size_t id) { return id < list.size() ? list[id] : 0.0; }
};

// The same; `sheet` may be null.
inline double area_of(const SheetWeights* sheet, PointId id) { return sheet != nullptr ? sheet->area_of(id) : 0.0; }
inline double sheet_weight_of(const SheetWeights* sheet, SpringId id) { return sheet != nullptr ? sheet->sheet_weight_of(id) : 0.0; }

// Edits the weights of a scene; copies them only if something changes. The destructor removes them if no point or spring belongs to a sheet
// any more.
class SheetEdit {
 public:
  explicit SheetEdit(std::shared_ptr<const SheetWeights>& sheet) : sheet_(sheet) {}
  ~SheetEdit();
  SheetEdit(const SheetEdit&) = delete;
  SheetEdit& operator=(const SheetEdit&) = delete;

  void set(PointId id, double area) { set(&SheetWeights::area, static_cast<std::size_t>(id), area, area_of(sheet_.get(), id)); }
  void set(SpringId id, double spring_weight) {
    set(&SheetWeights::spring_weight, static_cast<std::size_t>(id), spring_weight, sheet_weight_of(sheet_.get(), id));
  }

 private:
  void set(NumberList SheetWeights::*list, std::size_t id, double value, double before);

  std::shared_ptr<const SheetWeights>& sheet_;
  std::optional<SheetWeights> changed_;
};

}  // namespace hooke
