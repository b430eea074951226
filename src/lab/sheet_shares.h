// What the points and springs of cloths are of the sheets that they make up: what material sliders turn numbers of a sheet into
// those of each point and spring with.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/system.h"

namespace hooke {

// By id. 0, as beyond the end: no part of one.
struct SheetShares {
  std::vector<double> area;   // [m^2], of each point
  std::vector<double> share;  // [1], of each spring

  double area_of(PointId id) const { return at(area, static_cast<std::size_t>(id)); }
  double share_of(SpringId id) const { return at(share, static_cast<std::size_t>(id)); }
  bool operator==(const SheetShares&) const = default;

 private:
  static double at(const std::vector<double>& list, std::size_t id) { return id < list.size() ? list[id] : 0.0; }
};

// The same where there may be no cloth.
inline double area_of(const SheetShares* sheet, PointId id) { return sheet != nullptr ? sheet->area_of(id) : 0.0; }
inline double share_of(const SheetShares* sheet, SpringId id) { return sheet != nullptr ? sheet->share_of(id) : 0.0; }

// Changes what a scene holds of its sheets; copies it only when something changes. In the end there is none where nothing is of
// a sheet.
class SheetEdit {
 public:
  explicit SheetEdit(std::shared_ptr<const SheetShares>& sheet) : sheet_(sheet) {}
  ~SheetEdit();
  SheetEdit(const SheetEdit&) = delete;
  SheetEdit& operator=(const SheetEdit&) = delete;

  void set(PointId id, double area) { set(&SheetShares::area, static_cast<std::size_t>(id), area, area_of(sheet_.get(), id)); }
  void set(SpringId id, double share) { set(&SheetShares::share, static_cast<std::size_t>(id), share, share_of(sheet_.get(), id)); }

 private:
  void set(std::vector<double> SheetShares::*list, std::size_t id, double value, double before);

  std::shared_ptr<const SheetShares>& sheet_;
  std::optional<SheetShares> changed_;
};

}  // namespace hooke
