#include "device/gpu_scene.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "device/constants.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/spring_limits.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

std::vector<float> rounded(std::span<const double> numbers) { return {numbers.begin(), numbers.end()}; }

// Throws std::runtime_error if a call has failed since the last time.
void check_errors(const GlFunctions& gl) {
  const GLenum error = gl.GetError();
  if (error == GL_CONTEXT_LOST) throw std::runtime_error(lost_context);
  if (error == GL_OUT_OF_MEMORY) throw std::runtime_error("out of memory");
  if (error != GL_NO_ERROR) throw std::runtime_error("error " + std::to_string(error) + " of OpenGL");
}

// Whether anything but springs and gravity changes the energy.
bool has_works(const Plan& plan) {
  return plan.hand.held || plan.hand.pull || !plan.forces.empty() || plan.has_contact() || plan.drag > 0.0 || plan.has_dashpots();
}

}  // namespace

// `content`: null where passes write it.
void GpuScene::fill(GLuint& buffer, std::size_t bytes, const void* content) {
  GLint64 max = 0;
  gl_->GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &max);
  if (static_cast<GLint64>(bytes) > max) throw std::runtime_error("its buffers contain at most " + std::to_string(max) + " bytes");
  if (buffer == 0) gl_->GenBuffers(1, &buffer);
  gl_->BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
  constexpr std::size_t min_bytes = 32;  // a buffer must not be empty
  gl_->BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes > 0 ? bytes : min_bytes), bytes > 0 ? content : nullptr,
                  GL_DYNAMIC_DRAW);
}

// Whether it differs from what the buffer contains, and was sent.
bool GpuScene::put(Binding binding, std::span<const std::byte> bytes) {
  std::vector<std::byte>& content = contents_[binding];
  if (buffers_[binding] != 0 && std::ranges::equal(content, bytes)) return false;
  content.assign(bytes.begin(), bytes.end());
  fill(buffers_[binding], bytes.size(), bytes.data());
  return true;
}

bool GpuScene::put(Binding binding, std::span<const double> numbers) {
  return is_single_ ? put(binding, std::as_bytes(std::span<const float>(rounded(numbers)))) : put(binding, std::as_bytes(numbers));
}

template <class Number>
std::vector<Number> GpuScene::read(GLuint buffer, std::size_t count) const {
  std::vector<Number> numbers(count, static_cast<Number>(-1));  // a lost context writes nothing
  gl_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl_->BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
  gl_->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(Number)), numbers.data());
  return numbers;
}

std::vector<double> GpuScene::read_numbers(GLuint buffer, std::size_t count) const {
  if (!is_single_) return read<double>(buffer, count);
  const auto numbers = read<float>(buffer, count);
  return {numbers.begin(), numbers.end()};
}

void GpuScene::upload(const FrameSteps& steps, const Motion& motion) {
  const Plan& plan = *plan_;
  if (!is_grid(plan) && (plan.spring.runs != runs_ || graph_.neighbors.first.size() != static_cast<std::size_t>(plan.points) + 1)) {
    runs_ = plan.spring.runs;
    graph_ = graph_of(plan);
  }
  put(FirstNeighbor, graph_.neighbors.first);
  put(Neighbors, graph_.neighbors.items);
  put(SpringEnds, graph_.ends);
  put(BreakLimits, limit_numbers(plan));
  put(PanelCorners, std::as_bytes(std::span(plan.force_data.panels)));
  const PointLists panels = plan.force_data.panels.empty() ? PointLists() : panels_of_points(plan);
  put(FirstPanel, panels.first);
  put(PanelsOfPoints, panels.items);
  put(Radii, plan.radius);
  put(FrameNumbers, frame_numbers(plan, steps));
  put(Moments, moment_numbers(plan, steps, motion.time));
  put(Colliders, collider_numbers(plan, steps, motion.time));
  fill(buffers_[Events], std::as_bytes(std::span<const Index>(std::vector<Index>(static_cast<std::size_t>(steps.count), 0))));
  if (inverse_mass_.size() != plan.inverse_mass.size()) {
    fill(buffers_[Accelerations], state_bytes() / 3, nullptr);
    fill(buffers_[Works], std::as_bytes(std::span<const std::byte>(std::vector<std::byte>(state_bytes()))));  // none yet
    fill(buffers_[Sums], 8 * device_sums * sizeof(double), nullptr);
  }
  const bool has_masses = inverse_mass_ == plan.inverse_mass;  // not where the hand takes or releases a point
  if (!has_masses)
    for (ResidentMotion& each : residents_) each.x.clear();
  inverse_mass_ = plan.inverse_mass;

  const double sweep = plan.has_dashpots() && steps.method.splits_dashpots ? 0.5 * steps.h : 0.0;
  if (!put(Springs, spring_numbers(plan)) && has_masses && sweep == sweep_) return;
  sweep_ = sweep;
  sweeps_ = sweep > 0.0 ? sweep_levels(plan, sweep) : SweepLevels();
  put(Sweeps, sweeps_.numbers);
}

void GpuScene::find_resident(const Motion& motion) {
  auto found = std::ranges::find_if(residents_, [&](const ResidentMotion& each) { return each.x == motion.x && each.v == motion.v; });
  const bool is_there = found != residents_.end();
  if (!is_there) --found;
  std::rotate(residents_.begin(), found, found + 1);
  ResidentMotion& resident = residents_.front();
  if (!is_there) {
    const std::vector<double> numbers = state_numbers(*plan_, motion);
    is_single_ ? fill(resident.states[0], std::as_bytes(std::span<const float>(rounded(numbers))))
               : fill(resident.states[0], std::as_bytes(std::span(numbers)));
    for (std::size_t s = 1; s < resident.states.size(); ++s) fill(resident.states[s], state_bytes(), nullptr);
    resident.state = 0;
  }
  resident_ = &resident;
  state_ = start_ = resident.state;
}

std::string GpuScene::definitions() const {
  const Plan& plan = *plan_;
  std::string lines = is_single_ ? "#define real float\n#define real3 vec3\n#define real4 vec4\n#define PI 3.14159265358979323846\n"
                                 : "#define real double\n#define real3 dvec3\n#define real4 dvec4\n#define PI 3.14159265358979323846lf\n";
  const auto define = [&](const char* name, int value) { lines += std::string("#define ") + name + " " + std::to_string(value) + "\n"; };
  define("SINGLE", is_single_);
  define("DASHPOTS", plan.has_dashpots() && sweeps_.begin.empty());
  define("GRID", is_grid(plan));
  if (is_grid(plan)) {
    define("ROWS", plan.spring.grids[0].rows);
    define("COLUMNS", plan.spring.grids[0].columns);
    define("STORED_ROWS", stored_rows(plan.spring.grids[0]));
  }
  define("PULL", plan.hand.pull.has_value());
  define("WIND", plan.forces.empty() ? 0 : plan.force_data.panels.empty() ? 2 : 1);
  define("COLLIDERS", static_cast<int>(plan.colliders.size()));
  define("WORKS", has_works(plan));
  define("FLAT", plan.dimensions == 2);
  return lines;
}

// Throws std::runtime_error with the first line of what the driver says.
GLuint GpuScene::program_of(std::string_view pass) {
  GLuint& known = programs_[definitions_ + std::string(pass)];
  if (known != 0) return known;
  const auto source_of = [](std::string_view name) { return std::ranges::find(compute_sources(), name, &ComputeSource::name)->text; };
  // sweeps take the place of dashpots, but not after impacts
  const bool is_impact = pass == "impact.comp";
  const std::string of_impacts = is_impact ? "#undef DASHPOTS\n#define DASHPOTS 1\n" : "";
  const std::string springs(is_impact || pass == "move.comp" ? source_of("springs.glsl") : "");
  const std::string text =
      "#version 430\n" + definitions_ + of_impacts + std::string(source_of("common.glsl")) + springs + std::string(source_of(pass));
  const char* source = text.c_str();
  const GLuint shader = gl_->CreateShader(GL_COMPUTE_SHADER), program = gl_->CreateProgram();
  gl_->ShaderSource(shader, 1, &source, nullptr);
  gl_->CompileShader(shader);
  gl_->AttachShader(program, shader);
  gl_->LinkProgram(program);
  int is_linked = 0;
  gl_->GetProgramiv(program, GL_LINK_STATUS, &is_linked);
  if (is_linked != 0) return known = program;
  std::array<char, 400> log{};
  gl_->GetProgramInfoLog(program, static_cast<int>(log.size()), nullptr, log.data());
  const std::string line(log.data());
  throw std::runtime_error("the driver refuses the shader " + std::string(pass) + ": " + line.substr(0, line.find('\n')));
}

void GpuScene::run(std::string_view pass, Index threads, int from, int to, const PassUniforms& call) {
  gl_->UseProgram(program_of(pass));
  gl_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, FromState, resident_->states[static_cast<std::size_t>(from)]);
  gl_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, ToState, resident_->states[static_cast<std::size_t>(to)]);
  const int acting = (call.acts_predicted ? 2 : 1) * plan_->points;
  // in the order of their locations
  const std::array uniforms{plan_->points, int(call.pass), call.moment, acting, call.substep, call.reused, call.first, call.end};
  for (std::size_t location = 0; location < uniforms.size(); ++location) gl_->Uniform1i(static_cast<int>(location), uniforms[location]);
  if (const auto& pull = plan_->hand.pull) {
    const auto point = [&](int part) { return pull->parts[static_cast<std::size_t>(part < pull->count ? part : 0)].point; };
    gl_->Uniform3i(static_cast<int>(uniforms.size()), point(0), point(1), point(2));
  }
  gl_->DispatchCompute(static_cast<GLuint>((threads + device_group - 1) / device_group), 1, 1);
  gl_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void GpuScene::move(const PassUniforms& call) {
  const int count = static_cast<int>(resident_->states.size()), after = (state_ + 1) % count,
            next = after == start_ ? (after + 1) % count : after;
  run("move.comp", plan_->points, state_, next, call);
  state_ = next;
}

// Where nothing acts between two substeps, the last kick of one and the first of the next are one: a pass for each.
void GpuScene::run_fused(const FrameSteps& steps) {
  if (&steps.method == &symplectic_euler) {
    for (int k = 0; k < steps.count; ++k) move({.pass = WholeKick, .moment = k});
    return;
  }
  move({.pass = FirstHalf});
  for (int k = 1; k < steps.count; ++k) move({.pass = WholeKick, .moment = k, .acts_predicted = true});
  move({.pass = LastHalf, .moment = steps.count, .acts_predicted = true});
}

void GpuScene::run_one_by_one(const FrameSteps& steps) {
  // forces at the end of a step are those of the next one, unless they depend on a velocity that was predicted
  const bool reuses = plan_->forces.empty() || &steps.method != &velocity_verlet;
  for (int k = 0; k < steps.count; ++k) {
    start_ = state_;
    if (!sweeps_.begin.empty()) {
      gl_->BindBuffer(GL_COPY_READ_BUFFER, present());
      state_ = (start_ + 1) % static_cast<int>(resident_->states.size());
      gl_->BindBuffer(GL_COPY_WRITE_BUFFER, present());
      gl_->CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, static_cast<GLsizeiptr>(state_bytes()));
      sweep(true);
    }
    if (&steps.method == &symplectic_euler) {
      move({.pass = WholeKick, .moment = k});
    } else {
      move({.pass = FirstHalf, .moment = k, .substep = k, .reused = reuses ? k - 1 : -1});
      move({.pass = LastHalf, .moment = k + 1, .acts_predicted = true, .substep = k});
    }
    if (!sweeps_.begin.empty()) sweep(false);
    if (!plan_->colliders.empty()) run("contact.comp", plan_->points, start_, state_, {.substep = k});
    if (!plan_->colliders.empty() && plan_->has_dashpots())
      run("impact.comp", plan_->points, state_, state_, {.acts_predicted = true, .substep = k});
    if (!plan_->spring.break_length.empty()) run("breaks.comp", plan_->springs, state_, start_, {.substep = k});
  }
}

void GpuScene::sweep(bool is_forward) {
  const auto levels = static_cast<Index>(sweeps_.begin.size()) - 1;
  for (Index n = 0; n < levels; ++n) {
    const Index level = is_forward ? n : levels - 1 - n, first = sweeps_.begin[level], end = sweeps_.begin[level + 1];
    run("sweep.comp", end - first, state_, state_, {.first = first, .end = end});
  }
}

// The works that the passes have measured since the `start` of the frame. What contact does is booked as by sim/contact/contact.cpp.
void GpuScene::book_works(const Field& start, Motion& motion) {
  run("sum.comp", device_sums, state_, state_, {.end = device_sums});
  std::array<double, 8> sums{};
  const std::vector<double> numbers = read_numbers(buffers_[Sums], sums.size() * device_sums);
  for (std::size_t n = 0; n < numbers.size(); ++n) sums[n % sums.size()] += numbers[n];
  const auto [hand, wind, drag, dashpots, contact, max_by_colliders, impulses, push] = sums;
  const double max_by_hand = plan_->hand.held ? impulses * glm::length(vector_at(*plan_, motion.v, *plan_->hand.held)) : 0.0;
  const double max = plan_->hand.held || plan_->collider_paths.any_moves ? max_by_colliders : 0.0;
  const double by_hand = std::clamp(contact, -max_by_hand, max_by_hand), by_colliders = std::clamp(contact - by_hand, -max, max);
  using enum EnergyCause;
  for (const auto& [cause, work] : {std::pair{Hand, hand + by_hand}, std::pair{Potentials, air_work(*plan_, start, motion.x)},
                                    std::pair{Forces, wind}, std::pair{Colliders, push + by_colliders}, std::pair{Drag, drag},
                                    std::pair{Dashpots, dashpots}, std::pair{Contact, contact - by_hand - by_colliders}})
    motion.energy.add(cause, work);
}

void GpuScene::break_springs(const std::vector<double>& limits, Motion& motion, std::vector<Index>& broken) {
  for (Index s = 0; s < plan_->springs; ++s)
    if (const double length = limits[2 * static_cast<std::size_t>(s) + 1]; length != 0.0) break_spring(*plan_, motion, s, length, broken);
  std::sort(broken.begin(), broken.end());
  refresh_grid_stiffness(*plan_);
  // the pass has changed them
  contents_[Springs].clear();
  contents_[BreakLimits].clear();
}

void GpuScene::advance(const GlFunctions& gl, Plan& plan, const FrameSteps& steps, Motion& motion, std::vector<Index>& broken) {
  gl_ = &gl;
  plan_ = &plan;
  upload(steps, motion);
  find_resident(motion);
  check_errors(gl);
  definitions_ = definitions();
  for (GLuint binding = Accelerations; binding < bindings; ++binding)
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffers_[binding]);

  const bool acts_between = plan.has_contact() || !plan.spring.break_length.empty();
  const bool changes_wind = !plan.forces.empty() && &steps.method == &velocity_verlet;
  acts_between || changes_wind || !sweeps_.begin.empty() ? run_one_by_one(steps) : run_fused(steps);

  const auto n = static_cast<std::size_t>(plan.points);
  const auto events = read<std::uint32_t>(buffers_[Events], static_cast<std::size_t>(steps.count));
  const bool breaks = std::ranges::any_of(events, [](std::uint32_t event) { return (event & 2u) != 0; });
  const auto numbers = read_numbers(present(), 8 * n);
  const auto limits = breaks ? read_numbers(buffers_[BreakLimits], 2 * plan.spring.break_length.size()) : std::vector<double>();
  check_errors(gl);
  if (numbers[4 * n - 1] < 0.0) throw std::runtime_error(lost_context);

  motion.time += steps.count * steps.h;
  motion.counts.force_evaluations += steps.count;
  const Field start = has_works(plan) ? motion.x : Field();
  read_state(numbers, plan, motion);
  if (has_works(plan)) book_works(start, motion);
  if (breaks) break_springs(limits, motion, broken);
  resident_->state = state_;
  resident_->x = motion.x;
  resident_->v = motion.v;
}

}  // namespace hooke
