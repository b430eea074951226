// Serialization of the parts of a scene that its file does not hold.
#pragma once

#include "base/json_field.h"
#include "base/json_writer.h"
#include "edit/command.h"

namespace hooke {

// The state of a run that is not in the scene file but needed to resume it: ids, the hand, the energy supplied, the memory of an adaptive
// method, and the tears.
struct ResumeState {
  static constexpr auto fields = names("point_ids", "spring_ids", "next_point_id", "next_spring_id", "grab", "collider_grab", "hand",
                                       "ledger", "memory", "torn", "tears");
  std::optional<std::vector<PointId>> point_ids;  // none: numbered from 0
  std::optional<std::vector<SpringId>> spring_ids;
  std::uint32_t next_point_id = 0, next_spring_id = 0;
  std::optional<GrabPoint::Item> grab;
  std::optional<GrabCollider::Item> collider_grab;
  Vec3 hand{0.0};
  EnergySupply supply;
  MethodMemory memory;
  std::uint32_t torn = 0;
  std::vector<std::shared_ptr<const Tear>> tears;
};
ResumeState resume_state_of(const Scene& scene);

// Writes an object and reads it. Throws InputError if it does not match the scene.
void write_resume_state(JsonWriter& out, const ResumeState& rest);
void restore_resume_state(const JsonField& field, Scene& scene);

}  // namespace hooke
