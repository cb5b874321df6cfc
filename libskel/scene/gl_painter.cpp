// The same pictures by OpenGL 3.3, in a context that needs no display: EGL on Mesa's surfaceless platform.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/paper.h"
#include "libskel/mesh/ink_hull.h"
#include "libskel/mesh/vertex_normals.h"
#include "libskel/scene/gl_painter.h"
#include "libskel/scene/shading.h"

namespace skel {
namespace {

[[noreturn]] void lacking(const std::string& what) {
  throw UnavailableError("no picture can be drawn by OpenGL here (" + what + "); use --painter software");
}

// Current in its thread as long as it lives.
class Context {
 public:
  Context() {
    const auto display_of =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (!display_of) lacking("EGL has no platforms");
    display_ = display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
      lacking("EGL does not start without a display");
    if (!eglBindAPI(EGL_OPENGL_API)) lacking("EGL has no OpenGL");
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display_, wanted, &config, 1, &count);
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                              3,
                              EGL_CONTEXT_MINOR_VERSION,
                              3,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_NONE};
    if (count > 0) context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
    if (context_ == EGL_NO_CONTEXT) lacking("no OpenGL 3.3");
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      eglDestroyContext(display_, context_);
      lacking("no OpenGL without a surface");
    }
  }
  ~Context() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Of several contexts the one that what follows is for.
  void makeCurrent() const {
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw UnavailableError("OpenGL has lost its context");
  }
  bool isSoftware() const {
    const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "SwiftShader"})
      if (renderer.find(name) != std::string::npos) return true;
    return false;
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec4 place;   // of the eye: x, y to the right and up, its distance; w: light
layout(location = 1) in vec3 color;   // u, v; or red, green, blue
layout(location = 2) in vec3 corner;  // 1 at the corner, 0 at the others
uniform vec2 scale;                   // to clip space, at distance 1
uniform vec2 depth_range;             // nearest, farthest
out vec3 v_color;
out float v_lit;
noperspective out vec3 v_corner;
void main() {
  float n = depth_range.x, f = depth_range.y;
  gl_Position = vec4(scale * place.xy, ((f + n) * place.z - 2 * f * n) / (f - n), place.z);
  v_color = color;
  v_lit = place.w;
  v_corner = corner;
})";

constexpr const char* kFragmentShader = R"(#version 330 core
in vec3 v_color;
in float v_lit;
noperspective in vec3 v_corner;
uniform sampler2D picture;
uniform bool textured, fill, wires;
uniform float opacity, wire_px, pale_from, shade_on_white;
uniform vec4 wire_color;
out vec4 result;  // alpha multiplied in
void main() {
  vec3 rgb = textured ? texture(picture, v_color.xy, -0.3).rgb : v_color;
  float pale = clamp((min(rgb.r, min(rgb.g, rgb.b)) - pale_from) / (1 - pale_from), 0, 1);
  rgb *= 1 - (1 - v_lit) * (1 - (1 - shade_on_white) * pale);  // shadeOf()
  vec4 seen = fill ? vec4(rgb, 1) * opacity : vec4(0);
  if (wires) {
    vec3 px = v_corner / max(fwidth(v_corner), 1e-6);
    float over = clamp(0.5 + 0.5 * wire_px - min(px.x, min(px.y, px.z)), 0, 1) * wire_color.a;
    if (!fill && over == 0) discard;
    seen = vec4(wire_color.rgb, 1) * over + seen * (1 - over);
  }
  result = seen;
})";

GLuint compiled(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (!done) {
    char why[200] = "";
    glGetShaderInfoLog(shader, sizeof why, nullptr, why);
    lacking(std::string("a shader is refused: ") + std::string(why, std::strcspn(why, "\n")));
  }
  return shader;
}

struct Corner {
  float place[4], color[3], corner[3];
};

constexpr int kSamples = 4;

class GlPainter : public MeshPainter {
 public:
  explicit GlPainter(const TriangleMesh& mesh)
      : triangles_(mesh.triangles),
        vertex_count_(mesh.vertices.rows()),
        ink_rgb_(mesh.ink.rgb),
        ink_reach_m_(inkReach(mesh)) {
    program_ = glCreateProgram();
    for (const GLuint shader :
         {compiled(GL_VERTEX_SHADER, kVertexShader), compiled(GL_FRAGMENT_SHADER, kFragmentShader)}) {
      glAttachShader(program_, shader);
      glDeleteShader(shader);
    }
    glLinkProgram(program_);
    GLint done = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &done);
    if (!done) lacking("the shaders do not fit together");
    glGenVertexArrays(1, &array_);
    glGenBuffers(1, &buffer_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    const auto attribute = [](GLuint index, int count, std::size_t offset) {
      glEnableVertexAttribArray(index);
      glVertexAttribPointer(index, count, GL_FLOAT, GL_FALSE, sizeof(Corner),
                            reinterpret_cast<const void*>(offset));
    };
    attribute(0, 4, offsetof(Corner, place));
    attribute(1, 3, offsetof(Corner, color));
    attribute(2, 3, offsetof(Corner, corner));
    if (!mesh.texture.empty() && mesh.uv.rows() == vertex_count_ && triangles_.rows() > 0) loadTexture(mesh);
  }

  bool isConcurrent() const override { return false; }
  bool isSoftware() const { return context_.isSoftware(); }

  Image paint(const Eigen::MatrixX3f& vertices, const Camera& camera, int width, int height,
              const Surface& surface) override {
    SKEL_CHECK_EQ(vertices.rows(), vertex_count_);
    SKEL_CHECK(width >= 1 && height >= 1);
    if (vertex_count_ == 0 || triangles_.rows() == 0) return blankImage(width, height, kClear);
    context_.makeCurrent();
    const bool textured = texture_ != 0 && !surface.colors;
    float nearest = 0, farthest = 0;
    fillCorners(vertices, camera, surface, textured, nearest, farthest);
    resizeTarget(width, height);

    glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_MULTISAMPLE);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(program_);
    const auto place = [&](const char* name) { return glGetUniformLocation(program_, name); };
    const double scale = 2 * camera.distance_m / camera.view_height_m;
    glUniform2f(place("scale"), float(scale * height / width), float(scale));
    glUniform2f(place("depth_range"), nearest, farthest);
    glUniform1i(place("picture"), 0);
    glUniform1i(place("textured"), textured);
    glUniform1i(place("fill"), surface.fill);
    glUniform1i(place("wires"), surface.wires);
    glUniform1f(place("opacity"), surface.opacity);
    glUniform1f(place("wire_px"), surface.wire_px);
    glUniform1f(place("pale_from"), kPaleFrom / 255);
    glUniform1f(place("shade_on_white"), kShadeOnWhite);
    const Color& ink = surface.wire_color;
    glUniform4f(place("wire_color"), float(ink.r) / 255, float(ink.g) / 255, float(ink.b) / 255,
                float(ink.a) / 255);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(corners_.size() * sizeof(Corner)), corners_.data(),
                 GL_STREAM_DRAW);
    if (surface.fill || surface.wires) glDrawArrays(GL_TRIANGLES, 0, GLsizei(body_corners_));
    glUniform1i(place("textured"), false);
    glUniform1i(place("wires"), false);
    glDrawArrays(GL_TRIANGLES, GLint(body_corners_), GLsizei(corners_.size() - body_corners_));
    return readBack(width, height);
  }

 private:
  void loadTexture(const TriangleMesh& mesh) {
    uv_.resize(3 * mesh.triangles.rows(), 2);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k) uv_.row(3 * t + k) = mesh.uvOf(t, k);
    const GLint wrap = uv_.minCoeff() < 0 || uv_.maxCoeff() > 1 ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, mesh.texture.width, mesh.texture.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, mesh.texture.rgba.data());
    glGenerateMipmap(GL_TEXTURE_2D);
  }

  // Three corners a triangle, so that each knows which of the three it is: the mesh's, then the ink's.
  void fillCorners(const Eigen::MatrixX3f& vertices, const Camera& camera, const Surface& surface,
                   bool textured, float& nearest, float& farthest) {
    const Eigen::Matrix3f eye = eyeFromModel(camera).cast<float>();
    const Eigen::Vector3f target = camera.target.cast<float>();
    const Eigen::MatrixX3f normals = vertexNormals(vertices, triangles_);
    const Eigen::Vector3f light = eye.transpose() * lightDirection();
    nearest = farthest = float(camera.distance_m);
    const auto seen = [&](const Eigen::MatrixX3f& places, const auto& lit_of, const auto& color_of) {
      std::vector<Corner> corners(std::size_t(places.rows()));
      for (Eigen::Index i = 0; i < places.rows(); ++i) {
        const Eigen::Vector3f p = eye * (places.row(i).transpose() - target);
        const float depth = float(camera.distance_m) - p.z();
        nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
        Corner& corner = corners[std::size_t(i)];
        corner = {{p.x(), p.y(), depth, lit_of(i)}, {0, 0, 0}, {0, 0, 0}};
        const Eigen::Vector3f rgb = color_of(i);
        for (int k = 0; k < 3; ++k) corner.color[k] = rgb[k] / 255;
      }
      return corners;
    };
    const std::vector<Corner> body = seen(
        vertices,
        [&](Eigen::Index i) {
          return 1 - surface.shading * (1 - std::clamp(normals.row(i).dot(light) + kLightReach, 0.f, 1.f));
        },
        [&](Eigen::Index i) {
          return surface.colors ? Eigen::Vector3f(surface.colors->row(i)) : surface.plain_rgb;
        });
    corners_.clear();
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t)
      for (int k = 0; k < 3; ++k) {
        corners_.push_back(body[std::size_t(triangles_(t, k))]);
        corners_.back().corner[k] = 1;
        if (textured)
          for (int axis : {0, 1}) corners_.back().color[axis] = uv_(3 * t + k, axis);
      }
    body_corners_ = corners_.size();
    if (surface.hasInk() && ink_reach_m_.size() > 0) {
      const InkHull ink = inkHull(vertices, triangles_, normals, ink_reach_m_, eyeOf(camera).cast<float>());
      const std::vector<Corner> hull = seen(
          ink.vertices, [](Eigen::Index) { return 1.f; }, [&](Eigen::Index) { return ink_rgb_; });
      for (const auto& t : ink.triangles.rowwise())
        for (const int v : t) corners_.push_back(hull[std::size_t(v)]);
    }
    farthest *= 1.01f;
    nearest = std::max(0.99f * nearest, 1e-4f * farthest);
  }

  void resizeTarget(int width, int height) {
    if (width == width_ && height == height_) return;
    releaseTarget();
    width_ = width, height_ = height;
    glGenFramebuffers(1, &drawn_);
    glGenFramebuffers(1, &resolved_);
    glGenRenderbuffers(3, stores_);
    const auto attach = [&](GLuint store, GLenum format, GLenum point, int samples) {
      glBindRenderbuffer(GL_RENDERBUFFER, store);
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, store);
    };
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
    attach(stores_[0], GL_RGBA8, GL_COLOR_ATTACHMENT0, kSamples);
    attach(stores_[1], GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, kSamples);
    const bool whole = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
    attach(stores_[2], GL_RGBA8, GL_COLOR_ATTACHMENT0, 0);
    if (!whole || glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      lacking("no frame of " + std::to_string(width) + "x" + std::to_string(height));
  }

  // The context's end frees the rest.
  void releaseTarget() {
    if (width_ == 0) return;
    glDeleteFramebuffers(1, &drawn_);
    glDeleteFramebuffers(1, &resolved_);
    glDeleteRenderbuffers(3, stores_);
  }

  Image readBack(int width, int height) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
    Image bottom_up(width, height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.rgba.data());
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
      const std::uint8_t* from = bottom_up.pixel(0, height - 1 - y);
      std::uint8_t* to = image.pixel(0, y);
      for (int x = 0; x < width; ++x, from += 4, to += 4) {
        const int alpha = from[3];
        for (int k = 0; k < 3; ++k)
          to[k] = alpha == 0 || alpha == 255
                      ? from[k]
                      : std::uint8_t(std::min(255, (from[k] * 255 + alpha / 2) / alpha));
        to[3] = from[3];
      }
    }
    return image;
  }

  Context context_;
  Eigen::MatrixX3i triangles_;
  Eigen::Index vertex_count_;
  Eigen::Vector3f ink_rgb_;
  Eigen::VectorXf ink_reach_m_;  // empty: no line around it
  Eigen::MatrixX2f uv_;          // a row for each corner of each triangle
  std::vector<Corner> corners_;
  std::size_t body_corners_ = 0;  // of them, the mesh's own
  GLuint program_ = 0, array_ = 0, buffer_ = 0, texture_ = 0;
  GLuint drawn_ = 0, resolved_ = 0, stores_[3] = {};  // frames: with samples, without; their memory
  int width_ = 0, height_ = 0;
};

}  // namespace

std::unique_ptr<MeshPainter> glPainter(const TriangleMesh& mesh, bool on_card_only) {
  auto painter = std::make_unique<GlPainter>(mesh);
  if (on_card_only && painter->isSoftware()) lacking("there is no graphics card");
  return painter;
}

}  // namespace skel
