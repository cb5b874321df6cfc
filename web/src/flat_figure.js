// The drawing itself, cut out and moved in its plane: what the core makes of it, as one mesh of three.js. It moves like a
// model that plays a clip.
import { BufferAttribute, BufferGeometry, CustomBlending, DataTexture, LinearFilter, Mesh, MeshBasicMaterial, OneFactor, OneMinusSrcAlphaFactor, SRGBColorSpace } from 'three';

export const kFlatRate_hz = 30;

export class FlatFigure {
  // `atlas`: the core's flat().
  constructor({ width, height, rgba, texcoords, vertex, triangles }) {
    const map = new DataTexture(rgba, width, height);
    map.colorSpace = SRGBColorSpace;
    map.magFilter = map.minFilter = LinearFilter;
    map.needsUpdate = true;
    this.vertex = vertex;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * vertex.length), 3));
    geometry.setAttribute('uv', new BufferAttribute(texcoords, 2));
    geometry.setIndex(new BufferAttribute(triangles, 1));
    // Painted in their order, whatever their depth.
    this.mesh = new Mesh(geometry, new MeshBasicMaterial({
      map, transparent: true, depthTest: false, depthWrite: false, side: 2, toneMapped: false,
      blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor,
    }));
    this.mesh.frustumCulled = false;
  }

  // `clip`: the core's flatClip().
  use(clip) {
    this.clip = clip;
    this.show(0);
  }

  show(time_s) {
    const { frames, duration, places } = this.clip;
    const at = Math.floor(duration ? time_s / duration * frames : 0) % frames * (places.length / frames);
    const { array } = this.mesh.geometry.attributes.position;
    for (let corner = 0; corner < this.vertex.length; ++corner) {
      array[3 * corner] = places[at + 2 * this.vertex[corner]];
      array[3 * corner + 1] = places[at + 2 * this.vertex[corner] + 1];
    }
    this.mesh.geometry.attributes.position.needsUpdate = true;
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.mesh.material.map.dispose();
    this.mesh.material.dispose();
  }
}
