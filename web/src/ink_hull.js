// The line around a figure that goes on from the drawing's own outline, as libskel/mesh/ink_hull.h has it: an inverted
// hull, pushed back along the line of sight so that it is seen only past what it surrounds.
import { BackSide, BufferAttribute, BufferGeometry, Color, MeshBasicMaterial, SkinnedMesh, SRGBColorSpace } from 'three';

const kInPlane = 0.4, kBehind = 2; // widths

function geometryOf(figure, width_m) {
  const { index, attributes: { position, normal, skinIndex, skinWeight } } = figure.geometry;
  const places = new Float32Array(3 * position.count);
  for (let v = 0; v < position.count; ++v) {
    const reach_m = width_m * Math.max(kInPlane, Math.abs(normal.getZ(v)));
    places[3 * v] = position.getX(v) + reach_m * normal.getX(v);
    places[3 * v + 1] = position.getY(v) + reach_m * normal.getY(v);
    places[3 * v + 2] = position.getZ(v) + reach_m * normal.getZ(v);
  }
  return new BufferGeometry().setIndex(index).setAttribute('position', new BufferAttribute(places, 3))
    .setAttribute('skinIndex', skinIndex).setAttribute('skinWeight', skinWeight);
}

function hullOf(figure) {
  const { width_m, rgb } = figure.userData.ink;
  const material = new MeshBasicMaterial({
    color: new Color().setRGB(...rgb.map((value) => value / 255), SRGBColorSpace), side: BackSide,
  });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace('#include <project_vertex>', `#include <project_vertex>
      vec4 pushed = projectionMatrix * vec4(mvPosition.xyz + behind * normalize(mvPosition.xyz), 1.0);
      gl_Position.z = pushed.z / pushed.w * gl_Position.w;`).replace('void main() {', 'uniform float behind;\nvoid main() {');
    shader.uniforms.behind = { value: kBehind * width_m };
  };
  material.customProgramCacheKey = () => 'ink';
  const hull = new SkinnedMesh(geometryOf(figure, width_m), material);
  hull.bind(figure.skeleton, figure.bindMatrix);
  figure.computeBoundingBox();
  hull.boundingBox = figure.boundingBox; // the line does not count
  return hull;
}

// `root`: the scene of a .glb of skel's without a hull of its own.
export function addInkHull(root) {
  const figures = [];
  root.traverse((part) => {
    if (part.isSkinnedMesh && Array.isArray(part.userData.ink?.rgb)) figures.push(part);
  });
  for (const figure of figures) figure.parent.add(hullOf(figure));
}
