// Sends to a window what a desktop environment sends and xdotool cannot, and hashes the screen quickly.
//   window_message close WINDOW
//   window_message drop WINDOW FILE...   by the XDND protocol, version 5 (freedesktop.org, "Drag-and-Drop Protocol for the X
//                                        Window System")
//   window_message digest WIDTH HEIGHT   prints a hash of the screen without its lower right corner
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <poll.h>

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>

namespace {

Display* display = nullptr;

Atom atom(const char* name) { return XInternAtom(display, name, False); }

void send(Window window, const char* type, std::initializer_list<long> numbers) {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = atom(type);
  event.xclient.format = 32;
  int i = 0;
  for (const long number : numbers) event.xclient.data.l[i++] = number;
  XSendEvent(display, window, False, NoEventMask, &event);
  XFlush(display);
}

bool next_event(XEvent& event) {
  pollfd waiting{ConnectionNumber(display), POLLIN, 0};
  while (XPending(display) == 0)
    if (poll(&waiting, 1, 10'000) <= 0) return false;
  XNextEvent(display, &event);
  return true;
}

// Sends the dragged data to the window that requests it.
void answer(const XSelectionRequestEvent& request, const std::string& list) {
  XChangeProperty(display, request.requestor, request.property, request.target, 8, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(list.data()), static_cast<int>(list.size()));
  XEvent event{};
  event.xselection.type = SelectionNotify;
  event.xselection.requestor = request.requestor;
  event.xselection.selection = request.selection;
  event.xselection.target = request.target;
  event.xselection.property = request.property;
  event.xselection.time = request.time;
  XSendEvent(display, request.requestor, False, NoEventMask, &event);
  XFlush(display);
}

// Whether the window accepted it.
bool drop(Window window, const std::string& list) {
  const Window source = XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0);
  XSetSelectionOwner(display, atom("XdndSelection"), source, CurrentTime);
  const auto from = static_cast<long>(source);
  Window root = 0, child = 0;
  int x = 0, y = 0, inside_x = 0, inside_y = 0;
  unsigned buttons = 0;
  XQueryPointer(display, window, &root, &child, &x, &y, &inside_x, &inside_y, &buttons);
  constexpr long version = 5L << 24;
  send(window, "XdndEnter", {from, version, static_cast<long>(atom("text/uri-list")), 0, 0});
  send(window, "XdndPosition", {from, 0, static_cast<long>(x) << 16 | y, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
  for (XEvent event; next_event(event);) {
    if (event.type == ClientMessage && event.xclient.message_type == atom("XdndStatus")) {
      if ((event.xclient.data.l[1] & 1) == 0) return false;
      send(window, "XdndDrop", {from, 0, CurrentTime, 0, 0});
    } else if (event.type == SelectionRequest) {
      answer(event.xselectionrequest, list);
    } else if (event.type == ClientMessage && event.xclient.message_type == atom("XdndFinished")) {
      return true;
    }
  }
  return false;
}

// Fowler-Noll-Vo hash (1991) of the pixels.
unsigned long digest(int width_left_out, int height_left_out) {
  const int screen = DefaultScreen(display), width = DisplayWidth(display, screen), height = DisplayHeight(display, screen);
  XImage* image =
      XGetImage(display, DefaultRootWindow(display), 0, 0, static_cast<unsigned>(width), static_cast<unsigned>(height), AllPlanes, ZPixmap);
  unsigned long hash = 14695981039346656037ul;
  for (int y = 0; y < height; ++y) {
    const int row = y < height - height_left_out ? width : width - width_left_out;
    for (int i = 0; i < row * image->bits_per_pixel / 8; ++i)
      hash = (hash ^ static_cast<unsigned char>(image->data[y * image->bytes_per_line + i])) * 1099511628211ul;
  }
  XDestroyImage(image);
  return hash;
}

int handle(const std::string& what, int count, char** arguments) {
  if (what == "digest" && count == 4) {
    std::printf("%lx\n", digest(std::atoi(arguments[2]), std::atoi(arguments[3])));
    return 0;
  }
  const Window window = std::strtoul(arguments[2], nullptr, 0);
  if (what == "close") {
    send(window, "WM_PROTOCOLS", {static_cast<long>(atom("WM_DELETE_WINDOW")), CurrentTime});
    XSync(display, False);
    return 0;
  }
  std::string list;
  for (int i = 3; i < count; ++i) list += "file://" + std::string(arguments[i]) + "\r\n";
  return what == "drop" && drop(window, list) ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  display = XOpenDisplay(nullptr);
  if (display == nullptr || count < 3) return 1;
  const int code = handle(arguments[1], count, arguments);
  XCloseDisplay(display);
  return code;
}
