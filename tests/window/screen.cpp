#include "screen.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XShm.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <poll.h>
#include <sys/ipc.h>
#include <sys/prctl.h>
#include <sys/shm.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <thread>

namespace glint::window {
namespace {

using Clock = std::chrono::steady_clock;

// Xvfb takes the first free number and tells it through a pipe.
std::string read_number(int descriptor) {
    std::string text;
    for (char c = 0; text.find('\n') == std::string::npos;) {
        pollfd end{descriptor, POLLIN, 0};
        if (::poll(&end, 1, 20'000) <= 0 || ::read(descriptor, &c, 1) != 1) return {};
        text += c;
    }
    text.pop_back();
    return text;
}

// A window may go away between two questions about it; that is no reason to end.
int ignore_error(Display*, XErrorEvent*) {
    return 0;
}

// A word to a window in the protocol of drag and drop (XDND 5, Lindal and others 1998).
void say(Display* display, ::Window from, ::Window to, const char* word,
         const std::array<long, 4>& data = {}) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = to;
    event.xclient.message_type = XInternAtom(display, word, False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(from);
    for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i + 1] = data[i];
    XSendEvent(display, to, False, NoEventMask, &event);
    XFlush(display);
}

bool hears(Display* display, ::Window window, int type, XEvent& event) {
    return eventually([&] { return XCheckTypedWindowEvent(display, window, type, &event); });
}

KeyCode code_of(Display* display, const std::string& name) {
    const KeyCode code = XKeysymToKeycode(display, XStringToKeysym(name.c_str()));
    if (code == 0) throw std::runtime_error("no key " + name);
    return code;
}

}  // namespace

std::ostream& operator<<(std::ostream& stream, const Colour& colour) {
    return stream << "rgb(" << colour.r << ", " << colour.g << ", " << colour.b << ")";
}

bool eventually(const std::function<bool()>& is_true, double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (!is_true()) {
        if (Clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

Screen::Screen(glm::ivec2 size, bool with_glx) : size_(size) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    const std::string mode = std::to_string(size.x) + "x" + std::to_string(size.y) + "x24";
    const std::string number = std::to_string(ends[1]);
    process_ = ::fork();
    if (process_ == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        ::close(ends[0]);
        if (!::freopen("/dev/null", "w", stderr)) ::_exit(127);
        ::execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", mode.c_str(),
                 "-nolisten", "tcp", "-noreset", with_glx ? "+extension" : "-extension", "GLX",
                 static_cast<char*>(nullptr));
        ::_exit(127);
    }
    ::close(ends[1]);
    const std::string answer = read_number(ends[0]);
    ::close(ends[0]);
    name_ = ":" + answer;
    if (!answer.empty()) display_ = XOpenDisplay(name_.c_str());
    if (!display_) {
        kill();
        throw std::runtime_error("Xvfb does not start");
    }
    XSetErrorHandler(ignore_error);
    share();
    move(size / 2);
}

// Through the socket a picture costs more than drawing most scenes, and the tests ask for hundreds.
void Screen::share() {
    const int id = ::shmget(IPC_PRIVATE, std::size_t{4} * static_cast<unsigned>(size_.x * size_.y),
                            IPC_CREAT | 0600);
    void* memory = id < 0 ? nullptr : ::shmat(id, nullptr, 0);
    XShmSegmentInfo info{
        .shmseg = 0, .shmid = id, .shmaddr = static_cast<char*>(memory), .readOnly = False};
    if (memory && memory != reinterpret_cast<void*>(-1) && XShmAttach(display_, &info)) {
        XSync(display_, False);
        segment_ = info.shmseg;
        pixels_ = static_cast<std::uint32_t*>(memory);
    }
    if (id >= 0) ::shmctl(id, IPC_RMID, nullptr);  // goes with the last of those who look
    if (!pixels_) {
        kill();
        throw std::runtime_error("Xvfb shares no memory");
    }
}

Screen::~Screen() {
    kill();
}

void Screen::kill() {
    if (display_) XCloseDisplay(display_);
    display_ = nullptr;
    if (pixels_) ::shmdt(pixels_);
    pixels_ = nullptr;
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);  // it takes its lock away with it
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
}

Colour Screen::pixel(glm::ivec2 at) const {
    const std::uint32_t rgb = picture(at, {1, 1})[0];
    return {static_cast<int>(rgb >> 16 & 255), static_cast<int>(rgb >> 8 & 255),
            static_cast<int>(rgb & 255)};
}

std::vector<std::uint32_t> Screen::picture(glm::ivec2 corner, glm::ivec2 size) const {
    XShmSegmentInfo info{.shmseg = segment_,
                         .shmid = 0,
                         .shmaddr = reinterpret_cast<char*>(pixels_),
                         .readOnly = False};
    const int screen = DefaultScreen(display_);
    XImage* image =
        XShmCreateImage(display_, DefaultVisual(display_, screen), 24, ZPixmap, info.shmaddr, &info,
                        static_cast<unsigned>(size.x), static_cast<unsigned>(size.y));
    const bool taken = image && XShmGetImage(display_, DefaultRootWindow(display_), image, corner.x,
                                             corner.y, AllPlanes);
    if (image) XDestroyImage(image);  // and not the memory behind it
    if (!taken) throw std::runtime_error("no screenshot");
    const std::ptrdiff_t count = std::ptrdiff_t{size.x} * size.y;
    for (std::ptrdiff_t i = 0; i < count; ++i) pixels_[i] &= 0xffffff;
    return {pixels_, pixels_ + count};
}

void Screen::move(glm::ivec2 to) {
    XTestFakeMotionEvent(display_, 0, to.x, to.y, CurrentTime);
    XSync(display_, False);
}

void Screen::button(bool down, int which) {
    XTestFakeButtonEvent(display_, static_cast<unsigned>(which), down, CurrentTime);
    XSync(display_, False);
}

void Screen::click(glm::ivec2 at, int which) {
    move(at);
    button(true, which);
    button(false, which);
}

// In a few moves, as a hand does.
void Screen::drag(glm::ivec2 from, glm::ivec2 to) {
    move(from);
    button(true);
    for (int i = 1; i <= 8; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        move(from + (to - from) * i / 8);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    button(false);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
}

void Screen::key(const char* name, bool down) {
    XTestFakeKeyEvent(display_, code_of(display_, name), down, CurrentTime);
    XSync(display_, False);
}

void Screen::tap(std::string_view chord) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at <= chord.size();) {
        const std::size_t end = std::min(chord.find('+', at), chord.size());
        names.emplace_back(chord.substr(at, end - at));
        at = end + 1;
    }
    for (const std::string& name : names) key(name.c_str(), true);
    for (auto name = names.rbegin(); name != names.rend(); ++name) key(name->c_str(), false);
}

void Screen::type(std::string_view text) {
    for (const char c : text) {
        const std::string name = c == '.'   ? "period"
                                 : c == '-' ? "minus"
                                 : c == '/' ? "slash"
                                            : std::string(1, c);
        tap(name);
    }
}

unsigned long Screen::window() const {
    ::Window root = 0, parent = 0, found = 0;
    ::Window* children = nullptr;
    unsigned count = 0;
    if (!XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count)) {
        return 0;
    }
    for (unsigned i = 0; i < count; ++i) {
        XTextProperty name{};
        XWindowAttributes attributes{};
        XGetWindowAttributes(display_, children[i], &attributes);
        if (attributes.c_class == InputOnly || !XGetWMName(display_, children[i], &name)) continue;
        if (name.value) found = children[i];
        XFree(name.value);
    }
    XFree(children);
    return found;
}

std::string Screen::title() const {
    const Atom utf8 = XInternAtom(display_, "UTF8_STRING", False);
    const Atom property = XInternAtom(display_, "_NET_WM_NAME", False);
    Atom type = 0;
    int format = 0;
    unsigned long count = 0, left = 0;
    unsigned char* text = nullptr;
    XGetWindowProperty(display_, window(), property, 0, 1024, False, utf8, &type, &format, &count,
                       &left, &text);
    const std::string title = text ? reinterpret_cast<const char*>(text) : "";
    if (text) XFree(text);
    return title;
}

glm::ivec2 Screen::window_size() const {
    XWindowAttributes attributes{};
    XGetWindowAttributes(display_, window(), &attributes);
    return {attributes.width, attributes.height};
}

void Screen::resize_window(glm::ivec2 size) {
    XResizeWindow(display_, window(), static_cast<unsigned>(size.x), static_cast<unsigned>(size.y));
    XSync(display_, False);
}

// What a window manager does.
void Screen::minimise(bool minimised) {
    const ::Window target = window();
    const Atom state = XInternAtom(display_, "WM_STATE", False);
    const std::array<long, 2> value = {minimised ? IconicState : NormalState, 0};
    if (minimised) XUnmapWindow(display_, target);
    XChangeProperty(display_, target, state, state, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(value.data()), 2);
    if (!minimised) XMapWindow(display_, target);
    XSync(display_, False);
}

void Screen::close_window() {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window();
    event.xclient.message_type = XInternAtom(display_, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
    event.xclient.data.l[1] = CurrentTime;
    XSendEvent(display_, window(), False, NoEventMask, &event);
    XSync(display_, False);
}

bool Screen::drop(const std::string& path) {
    const auto atom = [&](const char* name) { return XInternAtom(display_, name, False); };
    const auto word = [&](const char* name) { return static_cast<long>(atom(name)); };
    const ::Window target = window();
    const ::Window source =
        XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display_, atom("XdndSelection"), source, CurrentTime);
    const long at = 600 << 16 | 300;
    XEvent event{};
    say(display_, source, target, "XdndEnter", {5L << 24, word("text/uri-list"), 0, 0});
    say(display_, source, target, "XdndPosition", {0, at, CurrentTime, word("XdndActionCopy")});
    bool taken = hears(display_, source, ClientMessage, event) && (event.xclient.data.l[1] & 1);
    say(display_, source, target, "XdndDrop", {0, CurrentTime, 0, 0});
    taken = taken && hears(display_, source, SelectionRequest, event);
    if (taken) {
        const XSelectionRequestEvent request = event.xselectionrequest;
        const std::string list = "file://" + path + "\r\n";
        XChangeProperty(display_, request.requestor, request.property, request.target, 8,
                        PropModeReplace, reinterpret_cast<const unsigned char*>(list.data()),
                        static_cast<int>(list.size()));
        XEvent answer{};
        answer.xselection = {.type = SelectionNotify,
                             .serial = 0,
                             .send_event = True,
                             .display = display_,
                             .requestor = request.requestor,
                             .selection = request.selection,
                             .target = request.target,
                             .property = request.property,
                             .time = request.time};
        XSendEvent(display_, request.requestor, False, NoEventMask, &answer);
        taken = hears(display_, source, ClientMessage, event) &&
                event.xclient.message_type == atom("XdndFinished");
    }
    XDestroyWindow(display_, source);
    XFlush(display_);
    return taken;
}

void Screen::set_content_scale(int scale) {
    const std::string text = "Xft.dpi:\t" + std::to_string(96 * scale) + "\n";
    XChangeProperty(display_, DefaultRootWindow(display_), XA_RESOURCE_MANAGER, XA_STRING, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(text.data()),
                    static_cast<int>(text.size()));
    XSync(display_, False);
}

void Screen::focus(bool focused) {
    if (focused)
        XSetInputFocus(display_, window(), RevertToPointerRoot, CurrentTime);
    else
        XSetInputFocus(display_, 0, RevertToNone, CurrentTime);
    XSync(display_, False);
}

}  // namespace glint::window
