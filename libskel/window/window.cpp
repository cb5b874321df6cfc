#include "libskel/window/window.h"

#define GL_GLEXT_PROTOTYPES
#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GL/glext.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/window/font.h"

namespace skel {
namespace {

// Dear ImGui takes this many frames to settle after an event, e.g. for sizes that depend on the last frame's,
// and so long to fade what a dialog has dimmed.
constexpr int kSettlingFrames = 4;
constexpr double kSettling_s = 0.25;
// Between the two clicks of a double click; as on most desktops.
constexpr double kDoubleClick_s = 0.5;

std::string glfwProblem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown reason";
}

struct Glfw {
  Glfw() {
    if (!glfwInit())
      throw UnavailableError("no window can be opened (" + glfwProblem() + "): is there a display?");
  }
  ~Glfw() { glfwTerminate(); }
};

// What came from the keyboard and the left button since the last frame. GLFW's callbacks are plain functions;
// there is one window.
struct Input {
  std::vector<int> pressed_keys;
  int modifiers = 0;             // that were down when one of them was pressed
  std::optional<ImVec2> cursor;  // as of the last event
  std::vector<std::optional<ImVec2>>
      clicks;  // where the button went down, of presses that no frame has shown
  bool changed = false;
};
Input& input() {
  static Input input;
  return input;
}

void watchInput(GLFWwindow* window) {
  glfwSetKeyCallback(window, [](GLFWwindow*, int key, int, int action, int modifiers) {
    input().changed = true;
    if (key < 0 || action != GLFW_PRESS) return;
    input().pressed_keys.push_back(key);
    input().modifiers |= modifiers;
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow*, double x, double y) {
    input().cursor = ImVec2(static_cast<float>(x), static_cast<float>(y));
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow*, int button, int action, int) {
    input().changed = true;
    if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS) input().clicks.push_back(input().cursor);
  });
}

#if IMGUI_VERSION_NUM < 18700
// Up to 1.86, Dear ImGui sees only what is down when a frame begins: a key that is pressed and released
// between two frames would be lost, and of two clicks the second. Such keys are held down for one frame, such
// clicks are shown in frames of their own, where the button went down: the mouse may be elsewhere by now.
// From 1.87 on it has a queue of its own.
class Taps {
 public:
  // Before ImGui::NewFrame().
  void hold() {
    ImGuiIO& io = ImGui::GetIO();
    for (const int key : input().pressed_keys)
      if (!io.KeysDown[key]) {
        io.KeysDown[key] = true;
        held_.push_back(key);
      }
    input().pressed_keys.clear();
    takeModifiers();
    if (auto& clicks = input().clicks; !clicks.empty()) {
      io.MouseDown[0] = !was_down_;
      if (!was_down_) {
        if (clicks.front()) io.MousePos = *clicks.front();
        clicks.erase(clicks.begin());
      }
    }
    was_down_ = io.MouseDown[0];
  }
  // After it.
  void release() {
    for (const int key : held_) ImGui::GetIO().KeysDown[key] = false;
    held_.clear();
  }

 private:
  // Of a Ctrl+Z that is over before the frame begins, Ctrl counts, too, and in that frame alone.
  void takeModifiers() {
    ImGuiIO& io = ImGui::GetIO();
    const auto down = [&](int left, int right, int modifier) {
      return io.KeysDown[left] || io.KeysDown[right] || (input().modifiers & modifier) != 0;
    };
    io.KeyCtrl = down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL);
    io.KeyShift = down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT);
    io.KeyAlt = down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, GLFW_MOD_ALT);
    input().modifiers = 0;
  }

  std::vector<int> held_;
  bool was_down_ = false;  // the left button, in the last frame
};
#else
struct Taps {
  void hold() {
    input().pressed_keys.clear();
    input().clicks.clear();
  }
  void release() {}
};
#endif

// What of it the display has room for, below a title.
WindowOptions fitted(WindowOptions options) {
  constexpr int kTitle = 40;
  int x = 0, y = 0, width = 0, height = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
    glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  if (width > 0 && height > kTitle) {
    options.width = std::min(options.width, width);
    options.height = std::min(options.height, height - kTitle);
  }
  return options;
}

GLFWwindow* createWindow(const WindowOptions& asked) {
  const WindowOptions options = fitted(asked);
  // Shown with its first frame, not before.
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  GLFWwindow* window =
      glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  if (!window) throw UnavailableError("no window with OpenGL 3.3 can be opened (" + glfwProblem() + ")");
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  return window;
}

void chooseStyle(float scale) {
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.FrameRounding = style.GrabRounding = style.ScrollbarRounding = style.ChildRounding = 7;
  style.FramePadding = {12, 8};
  style.ItemSpacing = {8, 8};
  style.WindowPadding = {12, 12};
  style.WindowBorderSize = 0;
  style.ScrollbarSize = 16;
  style.Colors[ImGuiCol_WindowBg] = {0.957f, 0.961f, 0.973f, 1};
  style.Colors[ImGuiCol_ChildBg] = {1, 1, 1, 1};
  style.Colors[ImGuiCol_Button] = {0.886f, 0.902f, 0.937f, 1};
  style.Colors[ImGuiCol_ButtonHovered] = {0.80f, 0.85f, 0.94f, 1};
  style.Colors[ImGuiCol_ButtonActive] = {0.69f, 0.77f, 0.92f, 1};
  style.Colors[ImGuiCol_Header] = {0.80f, 0.87f, 0.98f, 1};
  style.Colors[ImGuiCol_HeaderHovered] = {0.87f, 0.91f, 0.99f, 1};
  style.Colors[ImGuiCol_HeaderActive] = {0.75f, 0.84f, 0.98f, 1};
  style.Colors[ImGuiCol_Text] = {0.13f, 0.16f, 0.22f, 1};
  style.ScaleAllSizes(scale);
}

struct Gui {
  explicit Gui(GLFWwindow* window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
    float scale_x = 1, scale_y = 1;
    glfwGetWindowContentScale(window, &scale_x, &scale_y);
    const float scale = std::clamp(std::max(scale_x, scale_y), 1.f, 4.f);
    constexpr float kLetters_px = 19;  // large enough to be read by a child
    addFont(*ImGui::GetIO().Fonts, kLetters_px * scale);
    chooseStyle(scale);
    watchInput(window);  // Dear ImGui calls what it finds before its own
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }
  ~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
};

NextFrame drawFrame(GLFWwindow* window, Taps& taps, const std::function<NextFrame()>& frame) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  taps.hold();
  ImGui::NewFrame();
  taps.release();
  const NextFrame next = frame();
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  glViewport(0, 0, width, height);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window);
  return next;
}

}  // namespace

struct Window::Parts {
  explicit Parts(const WindowOptions& options) : window(createWindow(options)), gui(window) {}
  Glfw glfw;
  GLFWwindow* window;
  Gui gui;
};

Window::Window(const WindowOptions& options) : parts_(std::make_unique<Parts>(options)) {}
Window::~Window() = default;

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(parts_->window, title.c_str()); }

bool Window::hasFocus() const { return glfwGetWindowAttrib(parts_->window, GLFW_FOCUSED) != 0; }

void Window::run(const std::function<NextFrame()>& frame, const std::function<bool()>& may_close) {
  int settling = kSettlingFrames;
  double settled_s = glfwGetTime() + kSettling_s;
  Taps taps;
  while (true) {
    if (glfwWindowShouldClose(parts_->window)) {
      if (!may_close || may_close()) break;
      glfwSetWindowShouldClose(parts_->window, GLFW_FALSE);
      settling = kSettlingFrames;
    }
    const double begun_s = glfwGetTime();
    const NextFrame next = drawFrame(parts_->window, taps, frame);
    // Clicks are seen when a frame begins: where frames are slow, the second one up to three of them later.
    ImGui::GetIO().MouseDoubleClickTime = static_cast<float>(kDoubleClick_s + 3 * (glfwGetTime() - begun_s));
    if (!glfwGetWindowAttrib(parts_->window, GLFW_VISIBLE)) glfwShowWindow(parts_->window);
    if (next == NextFrame::kClose) break;
    const bool sleeps = next == NextFrame::kOnInput && --settling <= 0 && glfwGetTime() >= settled_s;
    if (sleeps)
      glfwWaitEvents();
    else
      glfwPollEvents();
    // A press and its release may have come at once: each of them has a frame before the next sleep.
    if (std::exchange(input().changed, false) || sleeps) {
      settling = kSettlingFrames;
      settled_s = glfwGetTime() + kSettling_s;
    }
  }
}

Texture::~Texture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

void Texture::upload(const Image& image, Zoomed zoomed) {
  if (name_ == 0) glGenTextures(1, &name_);
  glBindTexture(GL_TEXTURE_2D, name_);
  // Mipmaps keep thin lines from breaking when zoomed out.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, zoomed == Zoomed::kSmooth ? GL_LINEAR : GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.rgba.data());
  glGenerateMipmap(GL_TEXTURE_2D);
}

}  // namespace skel
