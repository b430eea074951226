#include "ui/icons.h"

#include <initializer_list>
#include <vector>

namespace hooke {
namespace {

// Draws in a square from -1 to 1, y downwards.
struct Pen {
  ImDrawList& list;
  ImVec2 center;
  float half;  // half the side of the square
  ImU32 color;
  float width() const { return half * 0.18f; }
  ImVec2 at(float x, float y) const { return {center.x + half * x, center.y + half * y}; }

  void lines(std::initializer_list<ImVec2> places, bool closed = false) const {
    std::vector<ImVec2> path;
    for (const ImVec2& place : places) path.push_back(at(place.x, place.y));
    list.AddPolyline(path.data(), static_cast<int>(path.size()), color, closed ? ImDrawFlags_Closed : 0, width());
  }
  void area(std::initializer_list<ImVec2> places) const {
    std::vector<ImVec2> path;
    for (const ImVec2& place : places) path.push_back(at(place.x, place.y));
    list.AddConvexPolyFilled(path.data(), static_cast<int>(path.size()), color);
  }
  void dot(float x, float y, float radius) const { list.AddCircleFilled(at(x, y), half * radius, color); }
  void ring(float x, float y, float radius) const { list.AddCircle(at(x, y), half * radius, color, 0, width()); }
  // An arc about (x, y) with an arrowhead at its end; angles in radians, clockwise from the right.
  void arc(float x, float y, float radius, float from, float to) const {
    list.PathArcTo(at(x, y), half * radius, from, to, 24);
    list.PathStroke(color, 0, width());
  }
};

void select(const Pen& pen) {
  pen.area({{-0.6f, -0.9f}, {0.65f, 0.25f}, {0.05f, 0.32f}, {-0.6f, 0.8f}});
  pen.lines({{0.0f, 0.2f}, {0.38f, 0.9f}});
}

void add(const Pen& pen) {
  pen.ring(-0.1f, 0.1f, 0.72f);
  pen.lines({{-0.45f, 0.1f}, {0.25f, 0.1f}});
  pen.lines({{-0.1f, -0.25f}, {-0.1f, 0.45f}});
}

void attach(const Pen& pen) {
  pen.dot(-0.75f, 0.6f, 0.24f);
  pen.dot(0.75f, -0.6f, 0.24f);
  pen.lines({{-0.75f, 0.6f},
             {-0.42f, 0.34f},
             {-0.42f, -0.08f},
             {-0.02f, 0.22f},
             {0.02f, -0.22f},
             {0.42f, 0.08f},
             {0.42f, -0.34f},
             {0.75f, -0.6f}});
}

void nail(const Pen& pen) {
  pen.area({{-0.5f, -0.85f}, {0.5f, -0.85f}, {0.5f, -0.55f}, {-0.5f, -0.55f}});
  pen.area({{-0.16f, -0.55f}, {0.16f, -0.55f}, {0.16f, 0.45f}, {0.0f, 0.9f}, {-0.16f, 0.45f}});
}

void drag(const Pen& pen) {
  pen.dot(0.0f, 0.0f, 0.26f);
  for (const float side : {-1.0f, 1.0f}) {
    pen.lines({{-0.25f, side * 0.62f}, {0.0f, side * 0.9f}, {0.25f, side * 0.62f}});
    pen.lines({{side * 0.62f, -0.25f}, {side * 0.9f, 0.0f}, {side * 0.62f, 0.25f}});
  }
}

void remove(const Pen& pen) {
  pen.lines({{-0.65f, -0.65f}, {0.65f, 0.65f}});
  pen.lines({{0.65f, -0.65f}, {-0.65f, 0.65f}});
}

void release(const Pen& pen) {
  pen.lines({{-0.75f, -0.85f}, {0.75f, -0.85f}});
  pen.lines({{0.0f, -0.45f}, {0.0f, 0.8f}});
  pen.lines({{-0.5f, 0.3f}, {0.0f, 0.8f}, {0.5f, 0.3f}});
}

void run(const Pen& pen) { pen.area({{-0.55f, -0.8f}, {0.8f, 0.0f}, {-0.55f, 0.8f}}); }

void pause(const Pen& pen) {
  pen.area({{-0.62f, -0.75f}, {-0.18f, -0.75f}, {-0.18f, 0.75f}, {-0.62f, 0.75f}});
  pen.area({{0.18f, -0.75f}, {0.62f, -0.75f}, {0.62f, 0.75f}, {0.18f, 0.75f}});
}

void step(const Pen& pen) {
  pen.area({{-0.7f, -0.75f}, {0.35f, 0.0f}, {-0.7f, 0.75f}});
  pen.area({{0.42f, -0.75f}, {0.72f, -0.75f}, {0.72f, 0.75f}, {0.42f, 0.75f}});
}

void start(const Pen& pen) {
  pen.area({{0.85f, -0.7f}, {0.85f, 0.7f}, {0.15f, 0.0f}});
  pen.area({{0.15f, -0.7f}, {0.15f, 0.7f}, {-0.55f, 0.0f}});
  pen.area({{-0.85f, -0.75f}, {-0.6f, -0.75f}, {-0.6f, 0.75f}, {-0.85f, 0.75f}});
}

void undo(const Pen& pen) {
  pen.arc(0.05f, 0.15f, 0.6f, -3.0f, 1.4f);
  pen.area({{-0.95f, -0.12f}, {-0.15f, -0.12f}, {-0.55f, 0.45f}});
}

void redo(const Pen& pen) {
  pen.arc(-0.05f, 0.15f, 0.6f, 1.74f, 6.14f);
  pen.area({{0.95f, -0.12f}, {0.55f, 0.45f}, {0.15f, -0.12f}});
}

void step_back(const Pen& pen) {
  pen.area({{0.7f, -0.75f}, {0.7f, 0.75f}, {-0.35f, 0.0f}});
  pen.area({{-0.72f, -0.75f}, {-0.42f, -0.75f}, {-0.42f, 0.75f}, {-0.72f, 0.75f}});
}

void folder(const Pen& pen) {
  pen.lines({{-0.85f, 0.65f}, {-0.85f, -0.6f}, {-0.2f, -0.6f}, {0.05f, -0.3f}, {0.85f, -0.3f}, {0.85f, 0.65f}}, true);
}

void scene(const Pen& pen) {
  pen.lines({{-0.6f, -0.55f}, {0.65f, -0.2f}, {-0.1f, 0.7f}}, true);
  for (const ImVec2& at : {ImVec2{-0.6f, -0.55f}, ImVec2{0.65f, -0.2f}, ImVec2{-0.1f, 0.7f}}) pen.dot(at.x, at.y, 0.28f);
}

// open scissors
void cut(const Pen& pen) {
  pen.ring(-0.62f, 0.55f, 0.28f);
  pen.ring(-0.62f, -0.55f, 0.28f);
  pen.lines({{-0.4f, 0.38f}, {0.9f, -0.55f}});
  pen.lines({{-0.4f, -0.38f}, {0.9f, 0.55f}});
}

// In the order of the enumeration.
constexpr void (*drawings[])(const Pen&) = {select, add,   attach, nail, drag,      remove, release, run, pause,
                                            step,   start, undo,   redo, step_back, folder, scene,   cut};

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, ImVec2 center, float size, ImU32 color) {
  drawings[static_cast<int>(icon)](Pen{list, center, 0.5f * size, color});
}

}  // namespace hooke
