#include "app/window/window.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <glm/geometric.hpp>
#include <utility>

namespace hooke {
namespace {

static_assert(static_cast<int>(Key::Space) == GLFW_KEY_SPACE && static_cast<int>(Key::Period) == GLFW_KEY_PERIOD);
static_assert(static_cast<int>(Key::Escape) == GLFW_KEY_ESCAPE && static_cast<int>(Key::Enter) == GLFW_KEY_ENTER);
static_assert(static_cast<int>(Key::Delete) == GLFW_KEY_DELETE && static_cast<int>(Key::Home) == GLFW_KEY_HOME);
static_assert(static_cast<int>(Key::Right) == GLFW_KEY_RIGHT && static_cast<int>(Key::Left) == GLFW_KEY_LEFT);
static_assert(static_cast<int>(Key::Down) == GLFW_KEY_DOWN && static_cast<int>(Key::Up) == GLFW_KEY_UP);
static_assert(static_cast<int>(Key::F1) == GLFW_KEY_F1 && static_cast<int>(Key::F12) == GLFW_KEY_F12);
static_assert(static_cast<int>(Key::Alt) == GLFW_KEY_LEFT_ALT);
static_assert(static_cast<int>(Key::Tab) == GLFW_KEY_TAB && static_cast<int>(Key::Backspace) == GLFW_KEY_BACKSPACE);

// A key by the character that it types in the layout of the user, if that is ASCII; otherwise by its position.
Key key_of(int key, int scancode) {
  if (key == GLFW_KEY_KP_ENTER) return Key::Enter;
  const char* name = glfwGetKeyName(key, scancode);
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return static_cast<Key>('0' + key - GLFW_KEY_KP_0);
  const bool is_keypad = key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_EQUAL;
  if (name != nullptr && std::strlen(name) == 1 && !is_keypad) return static_cast<Key>(std::toupper(static_cast<unsigned char>(name[0])));
  return static_cast<Key>(key);
}

Modifiers modifiers_of(int mods) {
  return {.control = (mods & GLFW_MOD_CONTROL) != 0, .shift = (mods & GLFW_MOD_SHIFT) != 0, .alt = (mods & GLFW_MOD_ALT) != 0};
}

bool is_alt(int key) { return key == GLFW_KEY_LEFT_ALT || key == GLFW_KEY_RIGHT_ALT; }

bool is_down(GLFWwindow* window, int left, int right) {
  return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
}

Modifiers modifiers_now(GLFWwindow* window) {
  return {.control = is_down(window, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
          .shift = is_down(window, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
          .alt = is_down(window, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
}

// The last error of GLFW, on one line.
std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown error";
}

// Limits the window to the size of the screen.
void fit_to_screen(GLFWwindow* window) {
  GLFWmonitor* screen = glfwGetPrimaryMonitor();
  if (screen == nullptr) return;
  glm::ivec2 at, available, size;
  glfwGetMonitorWorkarea(screen, &at.x, &at.y, &available.x, &available.y);
  glfwGetWindowSize(window, &size.x, &size.y);
  if (available.x > 0 && available.y > 0 && (size.x > available.x || size.y > available.y))
    glfwSetWindowSize(window, std::min(size.x, available.x), std::min(size.y, available.y));
}

GLFWwindow* open_window(const std::string& title, const glm::ivec2& size) {
  if (glfwInit() != GLFW_TRUE) throw WindowError("cannot open a window: " + last_error());
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  // the scene is drawn to a framebuffer object
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "hooke");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "hooke");
  GLFWwindow* window = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
  if (window == nullptr) {
    const std::string error = last_error();
    glfwTerminate();
    throw WindowError("cannot open a window with OpenGL 3.3: " + error);
  }
  glfwSetWindowSizeLimits(window, 640, 420, GLFW_DONT_CARE, GLFW_DONT_CARE);
  fit_to_screen(window);
  return window;
}

// How a text field handles the key; shortcuts such as Ctrl+A are editing keys too.
QueuedInput::Kind kind_of(int key, int action, int mods) {
  if (action == GLFW_RELEASE) return QueuedInput::Kind::Release;
  if (action == GLFW_REPEAT) return QueuedInput::Kind::Other;
  const bool is_modifier = key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
  const bool types = key < GLFW_KEY_ESCAPE || (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_ADD) || key == GLFW_KEY_KP_EQUAL;
  return is_modifier || (types && (mods & GLFW_MOD_CONTROL) == 0) ? QueuedInput::Kind::Press : QueuedInput::Kind::Edit;
}

}  // namespace

// Callbacks queue the input; it is passed on to ImGui and to the program frame by frame.
struct Window::Callbacks {
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

  static void key(GLFWwindow* window, int key, int scancode, int action, int mods) {
    Window& self = of(window);
    const bool alt = self.is_alt_alone(key, action);
    self.inputs_.add({kind_of(key, action, mods), key, [&self, key, scancode, action, mods, alt] {
                        self.gui_->key(key, scancode, action, mods);
                        if (alt) self.press_key({Key::Alt, {}});
                        if (action != GLFW_RELEASE && !is_alt(key))
                          self.press_key({key_of(key, scancode), modifiers_of(mods), action == GLFW_REPEAT});
                      }});
  }
  static void character(GLFWwindow* window, unsigned code) {
    Window& self = of(window);
    self.inputs_.add({QueuedInput::Kind::Text, 0, [&self, code] { self.gui_->character(code); }});
  }

  static void button(GLFWwindow* window, int button, int action, int mods) {
    Window& self = of(window);
    self.alt_is_alone_ = false;
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return queue(window, [&self, button, action, mods] { self.gui_->button(button, action, mods); });
    const auto which = static_cast<Button>(button);
    const bool pressed = action == GLFW_PRESS, twice = pressed && self.is_second_press(which);
    queue(window, [&self, which, action, mods, pressed, twice, at = self.cursor_] {
      self.gui_->button(static_cast<int>(which), action, mods);
      if (pressed)
        self.events_.push_back(ButtonPress{which, at, modifiers_of(mods), twice});
      else
        self.events_.push_back(ButtonRelease{which, at, modifiers_of(mods)});
    });
  }
  static void cursor(GLFWwindow* window, double x, double y) {
    Window& self = of(window);
    self.cursor_ = {x, y};
    queue(window, [&self, move = CursorMove{self.cursor_, modifiers_now(window)}] {
      // of consecutive moves only the last one counts
      if (!self.events_.empty() && std::holds_alternative<CursorMove>(self.events_.back()))
        self.events_.back() = move;
      else
        self.events_.push_back(move);
    });
  }
  static void scroll(GLFWwindow* window, double x, double y) {
    Window& self = of(window);
    self.alt_is_alone_ = false;
    queue(window, [&self, x, y, at = self.cursor_] {
      self.gui_->scroll(x, y);
      self.events_.push_back(Scroll{y, at});
    });
  }
  static void focus(GLFWwindow* window, int focused) {
    of(window).alt_is_alone_ = false;  // Alt+Tab
    of(window).gui_->focus(focused);
  }
  static void enter(GLFWwindow* window, int entered) {
    of(window).gui_->enter(entered);
    if (!entered) queue(window, [&self = of(window)] { self.events_.push_back(CursorLeave{}); });
  }
  static void drop(GLFWwindow* window, int count, const char** paths) {
    if (count > 0) queue(window, [&self = of(window), file = std::filesystem::path(paths[0])] { self.events_.push_back(FileDrop{file}); });
  }
  static void close(GLFWwindow* window) {
    glfwSetWindowShouldClose(window, GLFW_FALSE);
    queue(window, [&self = of(window)] { self.events_.push_back(CloseRequest{}); });
  }

 private:
  static void queue(GLFWwindow* window, std::function<void()> apply) {
    of(window).inputs_.add({QueuedInput::Kind::Other, 0, std::move(apply)});
  }
};

// Keys typed into a text field are not passed on, except those that end the input.
void Window::press_key(const KeyPress& press) {
  const bool leaves_text =
      press.key == Key::Escape || press.key == Key::Enter || press.key == Key::F1 || press.key == Key::Up || press.key == Key::Down;
  if (!gui_->wants_text() || leaves_text) events_.push_back(press);
}

static_assert(static_cast<int>(Button::Left) == GLFW_MOUSE_BUTTON_LEFT && static_cast<int>(Button::Right) == GLFW_MOUSE_BUTTON_RIGHT &&
              static_cast<int>(Button::Middle) == GLFW_MOUSE_BUTTON_MIDDLE);

Window::Window(const std::string& title, const glm::ivec2& size) : window_(open_window(title, size)), title_(title) {
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);

  gui_ = std::make_unique<ImGuiBackend>(window_);

  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, Callbacks::key);
  glfwSetCharCallback(window_, Callbacks::character);
  glfwSetMouseButtonCallback(window_, Callbacks::button);
  glfwSetCursorPosCallback(window_, Callbacks::cursor);
  glfwSetScrollCallback(window_, Callbacks::scroll);
  glfwSetWindowFocusCallback(window_, Callbacks::focus);
  glfwSetCursorEnterCallback(window_, Callbacks::enter);
  glfwSetDropCallback(window_, Callbacks::drop);
  glfwSetWindowCloseCallback(window_, Callbacks::close);
}

// Whether this ends a press of Alt during which nothing else was pressed.
bool Window::is_alt_alone(int key, int action) {
  if (action == GLFW_RELEASE) return key == GLFW_KEY_LEFT_ALT && std::exchange(alt_is_alone_, false);
  if (action == GLFW_PRESS) alt_is_alone_ = key == GLFW_KEY_LEFT_ALT;
  return false;
}

// Whether this press makes a double click.
bool Window::is_second_press(Button button) {
  constexpr double time = 0.4, max_distance = 5.0;  // [s], [window units]
  const double now = glfwGetTime();
  const bool second =
      button == last_press_.button && now - last_press_.time < time && glm::distance(cursor_, last_press_.at) < max_distance;
  // a third press is a first one again
  last_press_ = {button, second ? -1.0 : now, cursor_};
  return second;
}

Clipboard Window::clipboard() {
  return {.put = [this](const std::string& text) { glfwSetClipboardString(window_, text.c_str()); },
          .take =
              [this] {
                const char* text = glfwGetClipboardString(window_);
                return std::string(text != nullptr ? text : "");
              }};
}

Window::~Window() {
  gui_.reset();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::wait(double seconds) {
  if (seconds > 0.0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

std::vector<Event> Window::take_events() {
  inputs_.apply_frame();
  return std::exchange(events_, {});
}

glm::dvec2 Window::size() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return {width, height};
}

glm::ivec2 Window::framebuffer_size() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {width, height};
}

// The scale of GLFW is in framebuffer pixels; a window unit may already be several of them.
double Window::content_scale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  const glm::dvec2 in_units = size();
  const double density = in_units.x > 0.0 ? framebuffer_size().x / in_units.x : 1.0;
  return x > 0.0f && density > 0.0 ? x / density : 1.0;
}

bool Window::is_hidden() const {
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0 || framebuffer_size().x == 0 || framebuffer_size().y == 0;
}

double Window::refresh_period() const {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  return mode != nullptr && mode->refreshRate > 0 ? 1.0 / mode->refreshRate : 1.0 / 60.0;
}

void Window::set_title(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::swap() { glfwSwapBuffers(window_); }

}  // namespace hooke
