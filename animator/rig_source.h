// Models and skeletons, as the commands of skel-animate name them.
#pragma once

#include <string>

#include "libskel/import/read_character.h"

namespace CLI {
class App;
}

namespace skel {

struct RigSource {
  std::string model;        // .glb, or what readMesh() reads
  std::string skeleton;     // a file of the elk system or a .skeleton.json; empty: that of the .glb
  std::string up = "auto";  // of the skeleton's file: y, z, or as it lies in the mesh
};
// MODEL, --skeleton, --up.
void bindRigSource(CLI::App& app, RigSource& source);

struct RigModel {
  CharacterFile file;  // the weights are empty, and the clips, unless all came from one .glb
  // How the skeleton was turned and what of its file is not used, for the user, in lines; may be empty.
  std::string note;
  std::string warning;  // of a skeleton most of which lies outside of the model: a line; may be empty
};
// Throws InputError, and UsageError where there is no skeleton.
RigModel readRigModel(const RigSource& source);

// The skeleton of a file, in the frame of `mesh`; as above.
Skeleton readSkeletonFor(const TriangleMesh& mesh, const std::string& path, const std::string& up,
                         std::string* note, std::string* warning);

// The name of a file without folder and ending.
std::string stemOf(const std::string& path);

}  // namespace skel
