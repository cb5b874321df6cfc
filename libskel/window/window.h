// A window with Dear ImGui in it (GLFW, OpenGL 3.3), for the tools that have one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "libskel/image/image.h"

namespace skel {

struct WindowOptions {
  std::string title;
  int width = 1280, height = 800;  // screen coordinates; no more than there is room for
};

// What a frame asks for next.
enum class NextFrame {
  kOnInput,  // sleep until a key, the mouse or a resize
  kAtOnce,   // something moves
  kClose,
};

// One window a process.
class Window {
 public:
  // Throws UnavailableError (no display, no OpenGL 3.3).
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Calls `frame` between ImGui::NewFrame() and ImGui::Render() until it says kClose or the user closes the
  // window, which stays open where `may_close` says false.
  void run(const std::function<NextFrame()>& frame, const std::function<bool()>& may_close = {});
  void setTitle(const std::string& title);
  bool hasFocus() const;  // of the keyboard

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// A picture on the graphics card; lives shorter than the window.
class Texture {
 public:
  Texture() = default;
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  // Zoomed in, pixels are smooth, or squares.
  enum class Zoomed { kSmooth, kSquares };
  void upload(const Image& image, Zoomed zoomed = Zoomed::kSmooth);
  // For ImGui::Image() and ImDrawList::AddImage().
  void* id() const { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(name_)); }
  bool empty() const { return name_ == 0; }

 private:
  unsigned name_ = 0;
};

}  // namespace skel
