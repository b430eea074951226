// Serialization of commands to JSON and back, bit for bit, and of the parts of a scene that are not in its file.
#pragma once

#include "base/json_field.h"
#include "base/json_writer.h"
#include "edit/command.h"

namespace hooke {

// An object with one member, named like the command. A Replace cannot be written: a whole scene has its own text.
void write_command(JsonWriter& out, const Command& command);

// Whether a member is named like a command.
bool is_command(const JsonField& member);

// The command of such a member. Throws InputError for anything else.
Command read_command(const JsonField& member);

// The state of a run that is not in the scene file but needed to resume it: ids, the hand, the energy ledger, the memory of an adaptive
// method, and the tears.
struct ResumeState {
  std::optional<std::vector<PointId>> point_ids;  // none: numbered from 0
  std::optional<std::vector<SpringId>> spring_ids;
  std::uint32_t next_point_id = 0, next_spring_id = 0;
  std::optional<GrabPoint::Item> grab;
  std::optional<GrabCollider::Item> collider_grab;
  Vec3 hand{0.0};
  EnergyLedger ledger;
  MethodMemory memory;
  std::uint32_t torn = 0;
  std::vector<std::shared_ptr<const Tear>> tears;
};
ResumeState resume_state_of(const Scene& scene);

// Writes an object and reads it. Throws InputError if it does not match the scene.
void write_resume_state(JsonWriter& out, const ResumeState& rest);
void restore_resume_state(const JsonField& field, Scene& scene);

}  // namespace hooke
