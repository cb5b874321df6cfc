// Where the joints of a drawing are, without a model: example_joints hero.png
#include <cstdio>
#include <exception>

#include "libskel/image/read_image.h"
#include "libskel/recognition/tree_recognition.h"

int main(int argc, char** argv) try {
  if (argc != 2) return std::fputs("usage: example_joints DRAWING\n", stderr), 1;
  const skel::Image image = skel::readImage(argv[1]);
  const skel::Silhouette silhouette = skel::extractSilhouette(image);
  if (!silhouette.found()) return std::fprintf(stderr, "%s: %s\n", argv[1], silhouette.reason.c_str()), 2;
  const skel::Recognition found = skel::recognizeByTree(image, silhouette, skel::loadTemplate("biped"),
                                                        skel::builtInJointNets().of("biped"));
  for (const skel::Joint& joint : found.skeleton.joints)
    std::printf("%-16s %7.1f %7.1f  %.2f\n", joint.name.c_str(), joint.image.x(), joint.image.y(),
                joint.confidence);
  return 0;
} catch (const std::exception& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 2;
}
