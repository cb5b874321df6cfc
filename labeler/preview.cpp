#include "labeler/preview.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "libskel/animation/sample_pose.h"
#include "libskel/deform/skin_vertices.h"
#include "libskel/draw/render_mesh.h"

namespace skel {

bool Preview::draw(const std::shared_ptr<const RiggedDrawing>& rigged, float width, float height) {
  if (shown_.isAnother(rigged)) {
    start_s_ = ImGui::GetTime();
    resting_ = false;
  }
  const float time_s = static_cast<float>(ImGui::GetTime() - start_s_);
  const RiggedCharacter& character = rigged->character;
  // Where no clip was made for the body plan, the character only turns.
  const Clip clip = rigged->clips.empty() ? Clip{} : rigged->clips.front();
  const float duration_s = std::max(clip.duration_s(), 2.5f);
  if (!resting_) {
    const float share = std::min(time_s / duration_s, 1.f);
    const Pose pose = samplePose(clip, character.skeleton, share * duration_s);
    const auto heights = character.mesh.vertices.col(1);
    const Eigen::MatrixX3f vertices =
        skinVertices(character.mesh.vertices, character.weights,
                     posedFromRest(character.skeleton, pose, heights.maxCoeff() - heights.minCoeff()));
    RenderOptions options;
    options.width = std::max(1, static_cast<int>(width));
    options.height = std::max(1, static_cast<int>(height));
    const double yaw_rad = 0.6 * std::sin(2 * M_PI * share);  // to and fro once, so that its depth shows
    Camera camera = framingCamera(character.mesh.vertices, 0, 0.08, width / height);
    camera.yaw_rad = yaw_rad;
    camera.view_height_m *= 1.12;  // room for raised hands
    texture_.upload(renderMesh(vertices, character.mesh, camera, options));
    resting_ = share >= 1;
  }
  ImGui::Image(texture_.id(), {width, height});
  if (ImGui::IsItemClicked()) shown_.forget();
  return !resting_;
}

}  // namespace skel
